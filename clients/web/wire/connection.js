// The protocol of sculptd over one WebSocket (proto/PROTOCOL.md): calls, their answers and chunks, events.

import {take_token_of_address, token} from './token.js';

/** Methods whose results are followed by a chunk. */
const CHUNKED = ['artifact.read', 'job.cell', 'job.samples'];
const PATIENCE_MS = [500, 1000, 2000, 4000, 8000];

/** An error of the server, in its words. */
export class ServerError extends Error {
  /** @param {{message: string, data: {code: string}}} error */
  constructor(error) {
    super(error.message);
    this.code = error.data.code;
  }
}

/** The socket closed before the answer came. */
export class Lost extends Error {}

/**
 * Keeps a connection for as long as the page lives, with the token of its address: a lost one is made again.
 * Events: `open` with what `hello` gave, `lost` with the wait in ms before the next try, `refused` with a ServerError, `event` with an event's params.
 */
export class Connection extends EventTarget {
  constructor() {
    super();
    /** @type {WebSocket | null} */
    this.socket = null;
    this.waiting = new Map();
    this.next_id = 1;
    this.tries = 0;
    /** @type {{settle: (chunk: Uint8Array) => void} | null} the answer whose chunk is still to come */
    this.unfinished = null;
    take_token_of_address();
    this.#open();
  }

  #open() {
    const socket = new WebSocket(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/v1/ws`);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => this.#greet();
    socket.onmessage = (message) => (typeof message.data === 'string' ? this.#on_line(message.data) : this.#on_chunk(message.data));
    socket.onclose = () => this.#on_close(socket);
    this.socket = socket;
  }

  /**
   * @param {string} method
   * @param {object} [params]
   * @param {Uint8Array} [chunk] of blob.put
   * @returns {Promise<any>} the result; of methods in CHUNKED with the bytes as `chunk`. Throws ServerError or Lost.
   */
  call(method, params = {}, chunk) {
    const id = this.next_id++;
    return new Promise((resolve, reject) => {
      if (this.socket?.readyState !== WebSocket.OPEN) return reject(new Lost('there is no connection to the server'));
      this.waiting.set(id, {resolve, reject, reads: CHUNKED.includes(method)});
      this.socket.send(JSON.stringify({jsonrpc: '2.0', id, method, params}));
      if (chunk) this.socket.send(chunk);
    });
  }

  async #greet() {
    const known = token();
    try {
      const hello = await this.call('hello', {protocol: [1, 0], client: 'page/1.0', ...(known ? {token: known} : {})});
      this.tries = 0;
      this.#tell('open', hello);
    } catch (error) {
      if (error instanceof ServerError) this.#tell('refused', error);
    }
  }

  /** @param {string} text */
  #on_line(text) {
    const line = JSON.parse(text);
    if (line.method === 'event') return this.#tell('event', line.params);
    const asked = this.waiting.get(line.id);
    if (!asked) return;
    this.waiting.delete(line.id);
    if (line.error) return asked.reject(new ServerError(line.error));
    if (!asked.reads) return asked.resolve(line.result);
    this.unfinished = {settle: (chunk) => asked.resolve({...line.result, chunk})};
  }

  /** @param {ArrayBuffer} bytes */
  #on_chunk(bytes) {
    this.unfinished?.settle(new Uint8Array(bytes));
    this.unfinished = null;
  }

  /** @param {WebSocket} socket */
  #on_close(socket) {
    if (socket !== this.socket) return;
    this.socket = null;
    for (const {reject} of this.waiting.values()) reject(new Lost('the connection to the server was lost'));
    this.waiting.clear();
    const wait_ms = PATIENCE_MS[Math.min(this.tries++, PATIENCE_MS.length - 1)];
    this.#tell('lost', wait_ms);
    setTimeout(() => this.socket === null && this.#open(), wait_ms);
  }

  /** @param {string} name @param {any} detail */
  #tell(name, detail) {
    this.dispatchEvent(new CustomEvent(name, {detail}));
  }
}
