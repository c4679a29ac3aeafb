// What needs no library is begun before the libraries are there: the connection, the worker, and the timeline of the job that the address names.

import {read_link} from './link.js';
import {ask_ahead} from './plan/follow.js';
import {Connection} from './wire/connection.js';
import {take_token_of_address} from './wire/token.js';

take_token_of_address();
export const link = read_link();
export const connection = new Connection();
connection.open();
/** stock/worker.js */
export const worker = new Worker('/ui/stock/worker.js', {type: 'module'});
if (link.job) ask_ahead(link.job);
