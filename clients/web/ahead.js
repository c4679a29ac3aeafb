// What needs no library is begun before the libraries are there: the connection, and the worker.

import {Connection} from './wire/connection.js';
import {take_token_of_address} from './wire/token.js';

take_token_of_address();
export const connection = new Connection();
connection.open();
/** stock/worker.js */
export const worker = new Worker('/ui/stock/worker.js', {type: 'module'});
