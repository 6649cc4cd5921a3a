// What is said about a mesh: a sentence, and all of its report.
const words = (name) => name.replace(/[A-Z]/g, (letter) => ` ${letter.toLowerCase()}`);
const shown = (value) => (typeof value === 'number' ? Number(value.toPrecision(6)).toString() : value ? 'yes' : 'no');

export const sentence = (mesh, report) => [`${mesh.vertexCount} vertices, ${mesh.faceCount} faces, ${report.components} component${report.components === 1 ? '' : 's'}.`, ...report.remarks, ...(mesh.file?.remarks ?? [])].join(' ');

// Into a list of names and values.
export function showReport(list, { remarks, ...numbers }) {
  list.replaceChildren(...Object.entries(numbers).flatMap(([name, value]) => [
    Object.assign(document.createElement('dt'), { textContent: words(name) }),
    Object.assign(document.createElement('dd'), { textContent: shown(value) }),
  ]));
}
