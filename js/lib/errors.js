// The one exception type of the package: a code for programs, a sentence for people. Codes are those of the C++ library.

export class BrushfireError extends Error {
  constructor(code, message) {
    super(message);
    this.name = 'BrushfireError';
    this.code = code;
  }
}

export const invalid = (message) => new BrushfireError('invalid_argument', message);
