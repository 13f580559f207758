// SPDX-License-Identifier: BSD-3-Clause
// The table of joints. It inserts every text as plain text, because names come from the network.

// Removes the sign of a value that rounds to zero.
const number = (value, digits) => (typeof value === 'number' ? value.toFixed(digits).replace(/^-(0\.?0*)$/, '$1') : '–');

export class JointTable {
  /** Calls `onChoose(name)` when the user chooses a joint. */
  constructor(body, onChoose) {
    this.body = body;
    this.onChoose = onChoose;
    this.rows = new Map();
    this.chosen = null;
  }

  names() {
    return [...this.rows.keys()].sort();
  }

  choose(name) {
    this.chosen = name;
    for (const [other, row] of this.rows) row.setAttribute('aria-selected', String(other === name));
  }

  /** Chooses the joint `by` rows below the chosen one. */
  move(by) {
    const names = this.names();
    if (names.length === 0) return;
    const at = Math.min(names.length - 1, Math.max(0, names.indexOf(this.chosen) + by));
    this.onChoose(names[at]);
    this.rows.get(names[at]).scrollIntoView({block: 'nearest'});
  }

  remove(name) {
    this.rows.get(name)?.remove();
    this.rows.delete(name);
  }

  clear() {
    this.rows.clear();
    this.body.replaceChildren();
  }

  /** Shows the latest state of a joint. `silent_s`: its age. */
  show(name, state, words, silent_s) {
    const row = this.rows.get(name) ?? this.add(name);
    const error_rad = state.setpoint_position_rad - (state.link_position_rad ?? state.joint_position_rad);
    const known = state.temperature_status === 0;
    const cells = [
      name, silent_s > 2 ? `no state for ${silent_s.toFixed(0)} s` : (state.mode_text ?? String(state.mode)),
      number(state.joint_position_rad, 5), number(1000 * error_rad, 3), number(state.torque_commanded_Nm, 2),
      known ? number(state.temperature_used_C, 1) : (state.temperature_status_text ?? '–'), `${number(state.friction_factor, 2)} ×`, words.join('; '),
    ];
    cells.forEach((text, i) => {
      if (row.cells[i].textContent !== text) row.cells[i].textContent = text;
    });
    row.className = silent_s > 2 ? 'silent' : '';
    row.cells[7].className = state.fault ? 'fault' : 'notice';
  }

  add(name) {
    const row = document.createElement('tr');
    row.tabIndex = 0;
    row.setAttribute('aria-selected', 'false');
    for (let i = 0; i < 8; ++i) row.append(document.createElement('td'));
    row.addEventListener('click', () => this.onChoose(name));
    row.addEventListener('keydown', (event) => {
      if (event.key === 'Enter') this.onChoose(name);
    });
    const after = this.names().find((other) => other > name);
    this.body.insertBefore(row, after === undefined ? null : this.rows.get(after));
    this.rows.set(name, row);
    return row;
  }
}
