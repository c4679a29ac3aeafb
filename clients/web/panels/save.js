// Bytes of the page become a file of its user.

import {make} from '../dom.js';

const KEPT_MS = 60_000;  // a phone's viewer may come for them late

/** @param {Blob} blob @param {string} name */
export function save(blob, name) {
  const url = URL.createObjectURL(blob);
  make('a', {href: url, download: name}).click();
  setTimeout(() => URL.revokeObjectURL(url), KEPT_MS);
}

/** Opens it in the phone's own viewer, which stands it in the room. @param {Blob} blob */
export function show_in_room(blob) {
  const url = URL.createObjectURL(blob);
  make('a', {rel: 'ar', href: url}, make('img', {alt: ''})).click();  // the viewer asks for the picture in it
  setTimeout(() => URL.revokeObjectURL(url), KEPT_MS);
}

/** @returns {boolean} does this browser have such a viewer? */
export function has_room_viewer() {
  return make('a').relList.supports('ar');
}
