// What `brushfire view` has put into the page: a mesh as the bytes of a file, and what is to be shown of it.

// The bytes in an element, which is emptied: they are a third larger there.
function bytesIn(element) {
  const bytes = Uint8Array.from(atob(element.textContent), (c) => c.charCodeAt(0));
  element.textContent = '';
  return bytes;
}

// {bytes, name, state, values}, or null where the page holds no mesh. `values`: on the vertices, if they were computed
// elsewhere.
export function heldMesh(page) {
  const [mesh, state, values] = ['held-mesh', 'held-state', 'held-values'].map((id) => page.getElementById(id));
  if (!mesh) return null;
  const { name, ...rest } = JSON.parse(state.textContent);
  return { bytes: bytesIn(mesh), name, state: rest, values: values && new Float64Array(bytesIn(values).buffer) };
}

// Whoever shows the page in a frame hears where the sources are now.
export function tellFrame(sources) {
  if (window.parent !== window) window.parent.postMessage({ brushfire: { sources } }, '*');
}
