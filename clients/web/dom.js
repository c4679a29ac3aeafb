// Elements in one line, and figures as people read them.

/**
 * @param {string} tag
 * @param {Record<string, any>} [given] properties; `on` = listeners by event, `data`, `aria`, `class`
 * @param {...(Node | string | null | undefined | false)} inside
 * @returns {any}
 */
export function make(tag, given = {}, ...inside) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(given)) {
    if (name === 'on') for (const [event, listener] of Object.entries(value)) element.addEventListener(event, listener);
    else if (name === 'data') Object.assign(element.dataset, value);
    else if (name === 'aria') for (const [key, text] of Object.entries(value)) element.setAttribute(`aria-${key}`, text);
    else if (name === 'class') element.className = value;
    else if (name === 'role') element.setAttribute('role', value);
    else element[name] = value;
  }
  element.append(.../** @type {(Node | string)[]} */ (inside.filter((part) => part !== null && part !== undefined && part !== false)));
  return element;
}

/** Takes the place of what is in an element. @param {Element} element @param {...(Node | string | null | false | undefined)} inside */
export function fill(element, ...inside) {
  element.replaceChildren(.../** @type {(Node | string)[]} */ (inside.filter((part) => part !== null && part !== undefined && part !== false)));
}

/** @param {string} selector @returns {any[]} */
export function by_selector(selector) {
  return [...document.querySelectorAll(selector)];
}

/** @param {string} id @returns {any} */
export function by_id(id) {
  return document.getElementById(id);
}

/** @param {number} value "1 586 712" */
export function count(value) {
  return Math.round(value).toString().replace(/\B(?=(\d{3})+$)/g, '\u202f');
}

/** @param {number} part @param {number} whole */
export function percent(part, whole) {
  if (whole === 0) return '0 %';
  const share = (100 * part) / whole;
  return `${share === 100 || share === 0 ? share : share > 99.9 ? '99.9+' : share < 0.1 ? '< 0.1' : share.toFixed(1)} %`;
}

/** @param {number} value in seconds */
export function duration(value) {
  if (value < 0.0995) return `${Math.max(0, value * 1000).toFixed(0)} ms`;
  if (value < 99.5) return `${value.toFixed(value < 9.95 ? 1 : 0)} s`;
  const minutes = Math.round(value / 60);
  return minutes < 100 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

/** @param {number} bytes */
export function size(bytes) {
  const units = ['B', 'kB', 'MB', 'GB'];
  let at = 0, value = bytes;
  for (; value >= 999.5 && at < 3; ++at) value /= 1000;
  return `${at === 0 ? value : value.toFixed(value < 9.95 ? 1 : 0)} ${units[at]}`;
}

/** @param {string} utc "2026-01-31T12:00:00.000Z" */
export function ago(utc) {
  const seconds = (Date.now() - Date.parse(utc)) / 1000;
  if (seconds < 10) return 'just now';
  if (seconds < 86400) return `${duration(seconds)} ago`;
  return new Date(utc).toLocaleDateString();
}
