// A file of this machine becomes a blob on the server; what is there already is not sent again.

import {Sha256} from './sha256.js';

const PIECE = 1 << 20;

/**
 * @param {import('./connection.js').Connection} connection
 * @param {Blob} file
 * @param {(share: number) => void} tell how much is done, 0 to 1
 * @returns {Promise<string>} its hash
 */
export async function upload(connection, file, tell) {
  const hash = new Sha256();
  const piece_at = async (/** @type {number} */ at) => new Uint8Array(await file.slice(at, at + PIECE).arrayBuffer());
  for (let at = 0; at < file.size; at += PIECE) {
    hash.add(await piece_at(at));
    tell((0.3 * at) / file.size);
  }
  const sha256 = hash.hex();
  let {have, complete} = await connection.call('blob.has', {sha256});
  while (!complete) {
    const chunk = await piece_at(have);
    ({have, complete} = await connection.call('blob.put', {sha256, size: file.size, offset: have, bytes: chunk.length}, chunk));
    tell(0.3 + (0.7 * have) / file.size);
  }
  return sha256;
}
