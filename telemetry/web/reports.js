// SPDX-License-Identifier: BSD-3-Clause
// The opened reports, newest first. This browser stores them until the user removes them.
import {make} from './dom.js';
import {readReport} from './report.js';

const KEY = 'strainwave.reports';

/** Array of {name, opened, text}. It leaves out other entries, which another program may have stored. */
function kept() {
  try {
    return JSON.parse(localStorage.getItem(KEY)).filter((report) => ['name', 'opened', 'text'].every((key) => typeof report[key] === 'string'));
  } catch {
    return [];
  }
}

const keep = (reports) => localStorage.setItem(KEY, JSON.stringify(reports));
const others = (text) => kept().filter((report) => report.text !== text);

export class Reports {
  #section;
  #list;
  #shown = new Map(); // text to element

  /** Shows the stored reports in `list` of `section`. */
  constructor(section, list) {
    this.#section = section;
    this.#list = list;
    for (const report of kept().toReversed()) {
      try {
        this.#show(report);
      } catch {
        // A report of another version of the page may be unreadable here.
      }
    }
  }

  /** Shows and stores the report in `text`, a file called `name`. Throws Error with a text for the user. */
  open(name, text) {
    const report = {name, opened: new Date().toLocaleString('sv-SE').slice(0, 16), text};
    const element = this.#show(report);
    element.open = true;
    element.scrollIntoView({block: 'nearest'});
    try {
      keep([report, ...others(text)]);
    } catch {
      throw new Error(`${name}: shown, but not kept, since this browser's storage is full or off; remove a report, or allow the page to store data`);
    }
  }

  #show({name, opened, text}) {
    const content = readReport(name, text);
    const remove = make('button', {type: 'button'}, 'Remove');
    remove.addEventListener('click', () => {
      keep(others(text));
      this.#take(text);
    });
    const element = make('details', {}, make('summary', {}, `${name}, opened ${opened}`), make('div', {className: 'row'}, remove), ...content);
    this.#take(text);
    this.#shown.set(text, element);
    this.#list.prepend(element);
    this.#section.hidden = false;
    return element;
  }

  #take(text) {
    this.#shown.get(text)?.remove();
    this.#shown.delete(text);
    this.#section.hidden = this.#shown.size === 0;
  }
}
