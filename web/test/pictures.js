// Pictures compared: how much of two screenshots is not the same, given that edges are drawn a little differently by
// other versions of a browser.

// In the page: `a` and `b` are PNGs in base64. A pixel differs where its colour is far from that of every pixel beside the
// same place in the other picture. Returns how many do, and how many the surface has.
export function differing(page, a, b) {
  return page.evaluate(async ([first, second]) => {
    const FAR = 60; // of 255, in the most different channel: isolines are darker by more, antialiasing beside them is not
    const pixels = async (text) => {
      const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${text}`)).blob());
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
      context.drawImage(bitmap, 0, 0);
      return context.getImageData(0, 0, bitmap.width, bitmap.height);
    };
    const [p, q] = [await pixels(first), await pixels(second)];
    if (p.width !== q.width || p.height !== q.height) return { different: Infinity, compared: 0 };
    const distance = (i, j) => Math.max(...[0, 1, 2, 3].map((c) => Math.abs(p.data[i + c] - q.data[j + c])));
    const isNear = (x, y, from) => {
      const i = 4 * (y * p.width + x);
      for (let dy = -1; dy <= 1; ++dy) for (let dx = -1; dx <= 1; ++dx) {
        const j = 4 * ((y + dy) * p.width + x + dx);
        if ((from === p ? distance(i, j) : distance(j, i)) < FAR) return true;
      }
      return false;
    };
    let different = 0, compared = 0;
    for (let y = 1; y < p.height - 1; ++y) for (let x = 1; x < p.width - 1; ++x) {
      const i = 4 * (y * p.width + x);
      if (p.data[i + 3] < 128 && q.data[i + 3] < 128) continue;
      ++compared;
      if (!isNear(x, y, p) || !isNear(x, y, q)) ++different;
    }
    return { different, compared };
  }, [a, b]);
}
