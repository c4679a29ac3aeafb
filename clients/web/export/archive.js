// A ZIP archive without packing, in which each file's bytes begin at a multiple of 64: what USDZ asks for.

const ALIGNMENT = 64, LOCAL = 30, CENTRAL = 46, END = 22, EXTRA_HEAD = 4;
const FIRST_DAY = (1 << 5) | 1;  // 1980-01-01: the same bytes whenever it is made

const REMAINDERS = Uint32Array.from({length: 256}, (_, value) => {
  for (let bit = 0; bit < 8; ++bit) value = value & 1 ? (value >>> 1) ^ 0xedb88320 : value >>> 1;
  return value;
});

function crc32(bytes) {
  let sum = 0xffffffff;
  for (const byte of bytes) sum = (sum >>> 8) ^ REMAINDERS[(sum ^ byte) & 255];
  return ~sum >>> 0;
}

/** @param {[string, Uint8Array][]} files with names of ASCII @returns {Uint8Array<ArrayBuffer>} */
export function stored_archive(files) {
  let at = 0;
  const entries = files.map(([name, bytes]) => {
    const unaligned = at + LOCAL + name.length + EXTRA_HEAD, padding = (ALIGNMENT - (unaligned % ALIGNMENT)) % ALIGNMENT;
    const entry = {name, bytes, at, padding, start: unaligned + padding, sum: crc32(bytes)};
    at = entry.start + bytes.length;
    return entry;
  });
  const directory = at, directory_bytes = entries.reduce((sum, {name}) => sum + CENTRAL + name.length, 0);
  const out = new Uint8Array(directory + directory_bytes + END), view = new DataView(out.buffer);
  const put = (place, ...fields) => {  // [bytes, value] one behind the other
    for (const [size, value] of fields) {
      if (size === 2) view.setUint16(place, value, true);
      else view.setUint32(place, value, true);
      place += size;
    }
  };
  const put_name = (name, place) => out.set(new TextEncoder().encode(name), place);
  for (const {name, bytes, at: place, padding, start, sum} of entries) {
    put(place, [4, 0x04034b50], [2, 20], [2, 0], [2, 0], [2, 0], [2, FIRST_DAY], [4, sum], [4, bytes.length], [4, bytes.length], [2, name.length],
      [2, EXTRA_HEAD + padding]);
    put_name(name, place + LOCAL);
    put(place + LOCAL + name.length, [2, 0xffff], [2, padding]);
    out.set(bytes, start);
  }
  at = directory;
  for (const {name, bytes, at: place, sum} of entries) {
    put(at, [4, 0x02014b50], [2, 20], [2, 20], [2, 0], [2, 0], [2, 0], [2, FIRST_DAY], [4, sum], [4, bytes.length], [4, bytes.length], [2, name.length],
      [2, 0], [2, 0], [2, 0], [2, 0], [4, 0], [4, place]);
    put_name(name, at + CENTRAL);
    at += CENTRAL + name.length;
  }
  put(at, [4, 0x06054b50], [2, 0], [2, 0], [2, entries.length], [2, entries.length], [4, directory_bytes], [4, directory], [2, 0]);
  return out;
}
