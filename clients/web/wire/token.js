// The token that the server may ask for: from a field or once from `#token=`, kept for this tab only.

const KEY = 'sculptd-token';

/** Takes the token out of the address, so that it stays in no history. Call once, at the start. */
export function take_token_of_address() {
  const fields = new URLSearchParams(location.hash.slice(1));
  const token = fields.get('token');
  if (token === null) return;
  sessionStorage.setItem(KEY, token);
  fields.delete('token');
  history.replaceState(null, '', location.pathname + (fields.size ? `#${fields}` : ''));
}

/** @returns {string} empty: none */
export function token() {
  return sessionStorage.getItem(KEY) ?? '';
}

/** @param {string} text */
export function keep_token(text) {
  sessionStorage.setItem(KEY, text.trim());
}

/**
 * Reads from the server over HTTP.
 * @param {string} path below the server's address
 * @param {Record<string, string>} [headers]
 * @returns {Promise<Response>} 200 or 206; throws an Error with the server's sentence otherwise
 */
export async function get(path, headers = {}) {
  const known = token();
  const response = await fetch(path, {headers: known ? {...headers, Authorization: `Bearer ${known}`} : headers});
  if (response.ok) return response;
  const text = await response.text();
  let sentence = `the server answered ${response.status} to ${path}`;
  try {
    sentence = JSON.parse(text).message;
  } catch { /* it was not the server itself that answered */ }
  throw new Error(sentence);
}
