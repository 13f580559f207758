// SPDX-License-Identifier: BSD-3-Clause
// The last minutes of one joint, as ring buffers of numbers. They grow up to their capacity, so that short-lived names of joints take little memory.

// Plotted fields of state_v1, and values derived from them.
export const FIELDS = [
  'setpoint_position_rad', 'joint_position_rad', 'link_position_rad', 'error_mrad', 'joint_velocity_rad_s',
  'torque_commanded_Nm', 'torque_feedforward_Nm', 'torque_feedback_Nm', 'learned_load_Nm', 'temperature_used_C', 'friction_factor',
  'zero_velocity_weight', 'mode', 'fault',
];

export const KEPT_S = 600;
// Faster samples are thinned out, so that ten minutes of 64 joints fit into the memory of a small laptop.
const MOST_PER_S = 50;
const FIRST_ROWS = 256;

/** The plotted values of one state; missing ones are NaN. Errors in mrad. */
export function valuesOf(state) {
  const link = state.link_position_rad;
  const position = typeof link === 'number' && Number.isFinite(link) ? link : state.joint_position_rad;
  const derived = {error_mrad: 1000 * (state.setpoint_position_rad - position)};
  return FIELDS.map((field) => {
    const value = field in derived ? derived[field] : state[field];
    return typeof value === 'number' ? value : NaN;
  });
}

export class History {
  constructor(capacity = KEPT_S * MOST_PER_S, leastStep_s = 1 / MOST_PER_S) {
    this.capacity = capacity;
    this.leastStep_s = leastStep_s;
    this.time_s = new Float64Array(Math.min(capacity, FIRST_ROWS));
    this.columns = FIELDS.map(() => new Float32Array(this.time_s.length));
    this.clear();
  }

  // The rows are in order until the capacity is reached, so a plain copy suffices.
  grow() {
    const rows = Math.min(this.capacity, 2 * this.time_s.length);
    const larger = (column) => {
      const grown = new column.constructor(rows);
      grown.set(column);
      return grown;
    };
    this.time_s = larger(this.time_s);
    this.columns = this.columns.map(larger);
    this.next = this.size;
  }

  clear() {
    this.size = 0;
    this.next = 0;
    this.last_s = -Infinity;
  }

  /** Returns false if the sample is too close to the last one. A time that decreases clears the history. */
  add(time_s, values) {
    if (time_s < this.last_s) this.clear();
    // Half a step of tolerance keeps every sample at a rate of MOST_PER_S with jitter.
    if (time_s - this.last_s < 0.5 * this.leastStep_s) return false;
    if (this.size === this.time_s.length && this.size < this.capacity) this.grow();
    this.time_s[this.next] = time_s;
    for (let i = 0; i < FIELDS.length; ++i) this.columns[i][this.next] = values[i];
    this.next = (this.next + 1) % this.time_s.length;
    this.size = Math.min(this.size + 1, this.capacity);
    this.last_s = time_s;
    return true;
  }

  /** Times and the named columns from `from_s` to `to_s`, at most `most` rows. */
  window(names, from_s, to_s, most = 4000) {
    const at = (row) => (this.next - this.size + row + this.time_s.length) % this.time_s.length;
    const first = this.firstFrom(from_s, at);
    let last = this.firstFrom(to_s, at);
    if (last < this.size && this.time_s[at(last)] <= to_s) ++last;
    const step = Math.max(1, Math.ceil((last - first) / most));
    const picked = names.map((name) => this.columns[FIELDS.indexOf(name)]);
    const result = [[], ...names.map(() => [])];
    for (let row = first; row < last; row += step) {
      const index = at(row);
      result[0].push(this.time_s[index]);
      picked.forEach((column, i) => result[i + 1].push(Number.isNaN(column[index]) ? null : column[index]));
    }
    return result;
  }

  firstFrom(time_s, at) {
    let low = 0;
    let high = this.size;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.time_s[at(middle)] < time_s) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}
