// What `brushfire view` has put into the page: a mesh as the bytes of a file, and what is to be shown of it.

// {bytes, name, state}, or null where the page holds no mesh.
export function heldMesh(page) {
  const held = page.getElementById('held-mesh');
  if (!held) return null;
  const { name, ...state } = JSON.parse(page.getElementById('held-state').textContent);
  const bytes = Uint8Array.from(atob(held.textContent), (c) => c.charCodeAt(0));
  held.textContent = ''; // a third larger than the mesh
  return { bytes, name, state };
}
