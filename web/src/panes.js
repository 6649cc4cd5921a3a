// Views of one canvas side by side, or one below the other where that leaves them more room.

// {x, y, width, height} of each, from the upper left corner; all are of one size.
export function layout(width, height, count) {
  const isStacked = height > width;
  const size = { width: isStacked ? width : width / count, height: isStacked ? height / count : height };
  return Array.from({ length: count }, (_, k) => ({ x: isStacked ? 0 : k * size.width, y: isStacked ? k * size.height : 0, ...size }));
}

// What each shows, in words above it; nothing where there is only one.
export function showLabels(list, labels) {
  list.hidden = labels.length < 2;
  list.replaceChildren(...labels.map((text) => Object.assign(document.createElement('li'), { textContent: text })));
}
