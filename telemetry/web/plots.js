// SPDX-License-Identifier: BSD-3-Clause
// Plots of one joint over time, drawn by uPlot, with one cursor.
import uPlot from './uPlot.esm.js';

const COLOURS = {light: ['#0b5cad', '#b3400e', '#1b7a3d', '#7a3fa0'], dark: ['#7ab8ff', '#ffa169', '#7fdc9c', '#d3a6f5']};
const HEIGHT = 190;

export const PLOTS = [
  {title: 'Position, rad', fields: {setpoint_position_rad: 'setpoint', joint_position_rad: 'encoder', link_position_rad: 'link'}},
  {title: 'Error of the link, mrad', fields: {error_mrad: 'setpoint − position'}},
  {title: 'Torque, N·m', fields: {torque_commanded_Nm: 'commanded', torque_feedforward_Nm: 'feed-forward', torque_feedback_Nm: 'feedback', learned_load_Nm: 'learned load'}},
  {title: 'Velocity, rad/s', fields: {joint_velocity_rad_s: 'velocity'}},
  {title: 'Temperature, °C', fields: {temperature_used_C: 'used by the schedule'}},
  {title: 'Friction over the table, weight of rest', fields: {friction_factor: 'learned friction', zero_velocity_weight: 'zero-velocity weight'}},
];

const dark = () => matchMedia('(prefers-color-scheme: dark)').matches;
const ink = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
// Enough digits to resolve one encoder count at any position.
const number = (value) => String(Number(value.toPrecision(6)));
const shown = (u, value) => (value === null || value === undefined ? '–' : number(value));

export class Plots {
  /** `onZoom(from_s, to_s)` after a drag; `onReset()` after a double click. */
  constructor(parent, onZoom, onReset) {
    this.parent = parent;
    this.onZoom = onZoom;
    this.onReset = onReset;
    this.mark_s = null;
    this.build();
    new ResizeObserver(() => this.resize()).observe(parent);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.build());
  }

  build() {
    this.parent.replaceChildren();
    this.charts = PLOTS.map((plot) => {
      const figure = document.createElement('figure');
      const caption = document.createElement('figcaption');
      caption.textContent = plot.title;
      figure.append(caption);
      this.parent.append(figure);
      const colours = COLOURS[dark() ? 'dark' : 'light'];
      const axis = {stroke: ink('--faint'), grid: {stroke: ink('--line'), width: 1}, ticks: {stroke: ink('--line'), width: 1}};
      const options = {
        width: this.width(figure), height: HEIGHT,
        cursor: {sync: {key: 'bench'}, drag: {x: true, y: false, setScale: false}},
        series: [
          {label: 'time', value: (u, time_s) => (time_s === null ? '–' : this.timeText(time_s))},
          ...Object.values(plot.fields).map((label, i) => ({label, stroke: colours[i], width: 1.5, value: shown, spanGaps: false})),
        ],
        axes: [{...axis, space: 90, values: (u, ticks) => ticks.map((time_s) => this.timeText(time_s, 0))}, {...axis, size: 74, values: (u, ticks) => ticks.map(number)}],
        scales: {x: {time: false}},
        hooks: {
          setSelect: [(u) => {
            if (u.select.width < 3) return;
            this.onZoom(u.posToVal(u.select.left, 'x'), u.posToVal(u.select.left + u.select.width, 'x'));
            u.setSelect({left: 0, width: 0, top: 0, height: 0}, false);
          }],
          draw: [(u) => this.drawMark(u)],
        },
      };
      const chart = new uPlot(options, [[], ...Object.keys(plot.fields).map(() => [])], figure);
      chart.over.addEventListener('dblclick', () => this.onReset());
      return {chart, figure, names: Object.keys(plot.fields)};
    });
  }

  width(figure) {
    return Math.max(200, figure.clientWidth || this.parent.clientWidth || 300);
  }

  resize() {
    for (const {chart, figure} of this.charts) {
      const width = this.width(figure);
      if (chart.width !== width) chart.setSize({width, height: HEIGHT});
    }
  }

  /** Live times are times of day. Times of a recording count from its begin. */
  timeText(time_s, digits = 3) {
    if (time_s < 1e8) return `${time_s.toFixed(digits === 0 ? 2 : digits)} s`;
    const date = new Date(time_s * 1000);
    const two = (number) => String(number).padStart(2, '0');
    const seconds = (date.getSeconds() + date.getMilliseconds() / 1000).toFixed(digits).padStart(digits ? digits + 3 : 2, '0');
    return `${two(date.getHours())}:${two(date.getMinutes())}:${seconds}`;
  }

  drawMark(u) {
    if (this.mark_s === null || this.mark_s < u.scales.x.min || this.mark_s > u.scales.x.max) return;
    const x = u.valToPos(this.mark_s, 'x', true);
    u.ctx.save();
    u.ctx.strokeStyle = ink('--bad');
    u.ctx.setLineDash([6, 4]);
    u.ctx.beginPath();
    u.ctx.moveTo(x, u.bbox.top);
    u.ctx.lineTo(x, u.bbox.top + u.bbox.height);
    u.ctx.stroke();
    u.ctx.restore();
  }

  /** `mark_s`: the time of a fault, or null. */
  show(history, from_s, to_s, mark_s = null) {
    this.mark_s = mark_s;
    for (const {chart, names} of this.charts) {
      chart.batch(() => {
        chart.setData(history.window(names, from_s, to_s), false);
        chart.setScale('x', {min: from_s, max: to_s});
      });
    }
  }
}
