// The bytes of a job's timeline, as they are there or as they come.

import {get} from '../wire/token.js';

const PIECE = 1 << 20, PAUSE_MS = 120, LAST_LINES = 4096;

/**
 * A finished one: packed, in one go.
 * @param {string} job
 * @param {(bytes: Uint8Array) => void} take
 * @param {AbortSignal} signal
 */
export async function read_timeline(job, take, signal) {
  const response = await get(`/v1/artifacts/${job}/timeline?format=gzip`);
  const reader = response.body.pipeThrough(new DecompressionStream('gzip')).getReader();
  for (;;) {
    const {done, value} = await reader.read();
    if (done || signal.aborted) return;
    take(value);
  }
}

/**
 * One that grows, until it is final.
 * @param {{connection: import('../wire/connection.js').Connection, job: string, signal: AbortSignal}} of
 * @param {{take: (bytes: Uint8Array) => void, start_over: () => void, joints: (values: number[]) => void, is_over: () => boolean}} to `start_over`: the run began anew;
 *   `joints`: where they are at the end of what is there; `is_over`: the job has ended, whatever came of it
 */
export async function follow_timeline({connection, job, signal}, to) {
  let offset = 0;
  while (!signal.aborted) {
    const was_over = to.is_over();
    let piece;
    try {
      piece = await connection.call('artifact.read', {job, artifact: 'timeline', offset, bytes: PIECE});
    } catch (error) {
      if (error.code === 'wrong_state' && !was_over) {
        await pause(PAUSE_MS);
        continue;
      }
      throw error;
    }
    if (signal.aborted) return;
    if (piece.size < offset) {
      offset = 0;
      to.start_over();
      continue;
    }
    const {length} = piece.chunk;  // it may be given away by whoever takes it
    offset += length;
    if (length) to.take(piece.chunk);
    if (piece.eof) return;
    if (length < PIECE) await Promise.all([pause(PAUSE_MS), length ? read_last_joints(connection, job, to.joints) : null]);
  }
}

// From the last whole line of the growing trajectory.
async function read_last_joints(connection, job, joints) {
  try {
    const {size} = await connection.call('artifact.read', {job, artifact: 'trajectory', offset: 0, bytes: 1});
    const {chunk} = await connection.call('artifact.read', {job, artifact: 'trajectory', offset: Math.max(0, size - LAST_LINES), bytes: LAST_LINES});
    const lines = new TextDecoder().decode(chunk).split('\n').slice(1, -1);
    for (const line of lines.reverse()) {
      const {q} = JSON.parse(line);
      if (q) return joints(q);
    }
  } catch { /* the picture of the stock goes on without them */ }
}

const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
