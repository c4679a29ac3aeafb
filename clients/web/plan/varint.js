// Whole numbers as seven bits a byte, lowest first (docs/trajectory.md).

/** Reads numbers below 2^53 from bytes; `at` is where the next begins. */
export class Varints {
  /** @param {Uint8Array} bytes @param {number} [at] */
  constructor(bytes, at = 0) {
    this.bytes = bytes;
    this.at = at;
  }

  /** @returns {number} -1 where it does not end: then `at` stays */
  next() {
    const first = this.bytes[this.at];
    if (first < 128) {
      ++this.at;
      return first;
    }
    let value = 0, scale = 1;
    for (let at = this.at; at < this.bytes.length; scale *= 128) {
      const byte = this.bytes[at++];
      value += (byte & 127) * scale;
      if (byte < 128) {
        this.at = at;
        return value;
      }
    }
    return -1;
  }
}

/** @param {number} value of a varint @returns {number} */
export function signed(value) {
  return value % 2 ? -(value + 1) / 2 : value / 2;
}
