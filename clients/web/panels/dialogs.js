// The token that the server asks for, and what the keys do.

import {by_id, make} from '../dom.js';
import {keep_token, token} from '../wire/token.js';

const KEYS = [
  ['space', 'play or pause'], ['\u2190 \u2192', 'a row back or on'], ['shift \u2190 \u2192', '1 % back or on'], ['Home End', 'start, end'], ['L', 'follow a plan that is made'],
  ['A B', 'the loop begins, ends here'], ['1 to 5', 'cell, stock, front, right, top'], ['R', 'hide or show the robot'], ['W', 'the way of the tool around now'], ['C', 'next colouring of the stock'], ['N', 'new job'], ['/', 'filter the queue'],
  ['J K', 'next, previous job'], ['P', 'save a picture'], ['F', 'film it, or end the film'], ['?', 'this'], ['Esc', 'close'],
];

/** @param {string} sentence what the server said */
export function ask_token(sentence) {
  const dialog = by_id('token');
  const field = make('input', {id: 'token-field', type: 'password', autocomplete: 'off', value: token(), required: true});
  dialog.replaceChildren(make('form', {method: 'dialog', on: {submit: () => {
    keep_token(field.value);
    location.reload();
  }}},
    make('h2', {id: 'token-title'}, 'Who are you?'),
    make('p', {}, sentence),
    make('label', {htmlFor: 'token-field'}, 'Token (kept in this tab only)'), field,
    make('menu', {}, make('button', {type: 'button', on: {click: () => dialog.close()}}, 'Close'), make('button', {class: 'primary'}, 'Use it'))));
  if (!dialog.open) dialog.showModal();
}

export function show_help() {
  const dialog = by_id('help');
  dialog.replaceChildren(
    make('h2', {id: 'help-title'}, 'Keys'),
    make('table', {}, make('tbody', {}, ...KEYS.map(([keys, what]) => make('tr', {}, make('th', {scope: 'row'}, ...keys.split(' ').flatMap((key) => [make('kbd', {}, key), ' '])), make('td', {}, what))))),
    make('p', {class: 'hint'}, 'Drag turns the picture, the right button or two fingers move it, the wheel zooms. A click on a voxel says when it goes, or why it stays. '
      + 'The address of the page holds job, place and view: copy it to share what you see. Libraries: ', make('a', {href: '/ui/vendor/LICENSES.txt'}, 'licences'), '.'),
    make('form', {method: 'dialog'}, make('menu', {}, make('button', {class: 'primary'}, 'Close'))));
  dialog.showModal();
}
