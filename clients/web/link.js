// The address of the page behind `#`: which job is shown, at what moment, from where, and how.

/** @typedef {{job: string | null, at: number | null, place: string | null, look: string | null}} Link `at`: share of the keyframes; `place`: of the camera */

/** @returns {Link} */
export function read_link() {
  const fields = new URLSearchParams(location.hash.slice(1));
  return {job: fields.get('job'), at: fields.has('at') ? Number(fields.get('at')) : null, place: fields.get('view'), look: fields.get('look')};
}

const PAUSE_MS = 250;
/** @type {Link | null} */
let due = null;

/** In the place of the address that was, soon: browsers refuse to have it changed often. @param {Link} link */
export function write_link(link) {
  if (!due) setTimeout(write_due, PAUSE_MS);
  due = link;
}

function write_due() {
  const {job, at, place, look} = /** @type {Link} */ (due);
  due = null;
  const fields = new URLSearchParams({job: job ?? ''});
  if (at !== null) fields.set('at', at.toFixed(6));
  if (place !== null) fields.set('view', place);
  if (look !== null) fields.set('look', look);
  history.replaceState(null, '', `#${fields}`);
}
