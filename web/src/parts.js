// What the pool is made of: the package's own worker and module, which it finds by itself.
export const poolParts = async () => ({});
