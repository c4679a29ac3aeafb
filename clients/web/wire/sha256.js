// SHA-256 (FIPS 180-4) of bytes that come in pieces: the browser's own cannot do that, and is missing on plain HTTP.

const ROUND = new Uint32Array(64), START = new Uint32Array(8);
for (let candidate = 2, found = 0; found < 64; ++candidate) {
  let prime = true;
  for (let divisor = 2; divisor * divisor <= candidate; ++divisor) prime &&= candidate % divisor !== 0;
  if (!prime) continue;
  const fraction = (root) => Math.floor((root - Math.floor(root)) * 2 ** 32);
  if (found < 8) START[found] = fraction(Math.sqrt(candidate));
  ROUND[found++] = fraction(Math.cbrt(candidate));
}

const turn = (word, bits) => (word >>> bits) | (word << (32 - bits));

export class Sha256 {
  constructor() {
    this.state = START.slice();
    this.words = new Uint32Array(64);
    this.rest = new Uint8Array(64);
    this.bytes = 0;
  }

  /** @param {Uint8Array} piece */
  add(piece) {
    let at = 0;
    while (at < piece.length) {
      const filled = this.bytes % 64, taken = Math.min(64 - filled, piece.length - at);
      this.rest.set(piece.subarray(at, at + taken), filled);
      this.bytes += taken;
      at += taken;
      if (filled + taken === 64) this.#block(this.rest);
    }
  }

  /** @returns {string} 64 hex digits; nothing may be added afterwards */
  hex() {
    const bits = this.bytes * 8, filled = this.bytes % 64;
    const end = new Uint8Array((filled < 56 ? 64 : 128) - filled);
    end[0] = 0x80;
    new DataView(end.buffer).setBigUint64(end.length - 8, BigInt(bits));
    this.add(end);
    return [...this.state].map((word) => word.toString(16).padStart(8, '0')).join('');
  }

  /** @param {Uint8Array} block */
  #block(block) {
    const w = this.words, view = new DataView(block.buffer, block.byteOffset);
    for (let t = 0; t < 16; ++t) w[t] = view.getUint32(4 * t);
    for (let t = 16; t < 64; ++t) {
      const a = w[t - 15], b = w[t - 2];
      w[t] = w[t - 16] + w[t - 7] + (turn(a, 7) ^ turn(a, 18) ^ (a >>> 3)) + (turn(b, 17) ^ turn(b, 19) ^ (b >>> 10));
    }
    let [a, b, c, d, e, f, g, h] = this.state;
    for (let t = 0; t < 64; ++t) {
      const first = (h + (turn(e, 6) ^ turn(e, 11) ^ turn(e, 25)) + ((e & f) ^ (~e & g)) + ROUND[t] + w[t]) | 0;
      const second = ((turn(a, 2) ^ turn(a, 13) ^ turn(a, 22)) + ((a & b) ^ (a & c) ^ (b & c))) | 0;
      h = g; g = f; f = e; e = (d + first) | 0; d = c; c = b; b = a; a = (first + second) | 0;
    }
    [a, b, c, d, e, f, g, h].forEach((word, at) => { this.state[at] += word; });
  }
}
