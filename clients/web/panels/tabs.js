// The tabs of the inspector: one panel at a time, by mouse and arrow keys.

const tabs = () => /** @type {HTMLElement[]} */ ([...document.querySelectorAll('#tabs [role=tab]')]);
let tell = (_name) => {};

/** @param {(name: string) => void} on_shown */
export function start_tabs(on_shown) {
  tell = on_shown;
  for (const tab of tabs()) {
    tab.addEventListener('click', () => show_tab(tab.id.replace('tab-', '')));
    tab.addEventListener('keydown', (event) => {
      const way = {ArrowLeft: -1, ArrowRight: 1}[event.key];
      if (!way) return;
      const all = tabs(), next = all[(all.indexOf(tab) + way + all.length) % all.length];
      show_tab(next.id.replace('tab-', ''));
      next.focus();
    });
  }
}

/** @param {string} name */
export function show_tab(name) {
  for (const tab of tabs()) {
    const on = tab.id === `tab-${name}`;
    tab.setAttribute('aria-selected', String(on));
    tab.tabIndex = on ? 0 : -1;
    document.getElementById(`panel-${tab.id.replace('tab-', '')}`).hidden = !on;
  }
  tell(name);
}
