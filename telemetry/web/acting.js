// SPDX-License-Identifier: BSD-3-Clause
// Orders to joints: enable, hold, jog while a button is held, and a stop of all joints. The server provides this file only with an operator's key
// (--key). It signs the orders, and accepts them only from this page. All but stop need the token that the server printed.
// Orders quote session and challenge of the state on the page, so that the daemon refuses late ones.

import {make} from './dom.js';

const REPEAT_MS = 100; // interval of jog messages; the server ends a jog after 0.3 s of silence
const STOP_ANSWER_MS = 1000; // time-out for the first answer; the server confirms a stop at once, and reports the joints' answers later
const KEPT_ANSWERS = 5;

export class Acting {
  /** `bench`: data of the page. joints(): all live joints by name, each {channel, last, limits}; chosen(): the name of the chosen joint, or null. */
  constructor(connection, bench) {
    this.connection = connection;
    this.bench = bench;
    this.jogs = 0;
    this.jogging = null; // {button, number, velocity_rad_s, timer}
    this.jogShare = 0;
    this.stopTimer = null; // runs from a stop until the server's next answer
    this.build();
    this.listen();
    this.open();
  }

  build() {
    this.stopButton = make('button', {id: 'stop', type: 'button', textContent: 'Stop all joints (space)'});
    this.title = make('h2', {id: 'orders-title', textContent: 'Commands'});
    this.enableButton = make('button', {id: 'enable', type: 'button', textContent: 'Enable'});
    this.holdButton = make('button', {id: 'hold', type: 'button', textContent: 'Hold'});
    this.speed = make('input', {id: 'jog-speed', type: 'range', min: '1', max: '100', value: '50'});
    this.speedText = make('output', {id: 'jog-speed-text'});
    this.jogButtons = [['jog-down', '− jog'], ['jog-up', 'jog +']].map(([id, textContent]) => make('button', {id, type: 'button', textContent}));
    this.range = make('p', {id: 'orders-limits'});
    this.answers = make('ul', {id: 'answers'});
    this.answers.setAttribute('aria-label', 'Answers');
    this.answers.setAttribute('aria-live', 'polite');
    this.panel = make('div', {id: 'orders-panel', hidden: true},
      make('p', {className: 'row'}, this.enableButton, this.holdButton, this.jogButtons[0], this.jogButtons[1],
        make('label', {}, 'Speed ', this.speed, ' ', this.speedText)),
      this.range);
    this.locked = make('p', {id: 'orders-locked', textContent: 'This page can only stop joints. To enable, hold and jog, open the address with a token that strainwave-telemetry printed at its start.'});
    const section = make('section', {id: 'orders'}, this.title, this.locked, this.panel, this.answers);
    section.setAttribute('aria-labelledby', 'orders-title');
    document.querySelector('main').insertBefore(section, document.getElementById('plots-title').parentElement);
    document.body.append(this.stopButton);
    document.body.classList.add('acting');
  }

  listen() {
    this.stopButton.addEventListener('click', () => this.stop());
    this.enableButton.addEventListener('click', () => this.order('enable'));
    this.holdButton.addEventListener('click', () => this.order('hold'));
    this.speed.addEventListener('input', () => this.show());
    const isSpace = (event) => event.code === 'Space' && !event.ctrlKey && !event.metaKey && !event.altKey;
    // With any focus, the space bar stops and does not press a button or open a list. A held Enter presses a button once.
    addEventListener('keydown', (event) => {
      if (event.key === 'Enter' && event.repeat) event.preventDefault();
      if (!isSpace(event)) return;
      event.preventDefault();
      event.stopPropagation();
      if (!event.repeat) this.stop();
    }, true);
    addEventListener('keyup', (event) => isSpace(event) && event.preventDefault(), true);
    this.jogButtons.forEach((button, i) => {
      const sign = 2 * i - 1;
      button.addEventListener('pointerdown', (event) => {
        if (event.button !== 0) return;
        button.setPointerCapture(event.pointerId);
        this.jog(sign, button);
      });
      const released = () => this.jogging?.button === button && this.endJog();
      for (const kind of ['pointerup', 'pointercancel', 'lostpointercapture', 'blur']) button.addEventListener(kind, released);
      button.addEventListener('contextmenu', (event) => event.preventDefault());
      button.addEventListener('keydown', (event) => {
        if (event.key !== 'Enter') return;
        event.preventDefault();
        if (!event.repeat) this.jog(sign, button);
      });
      button.addEventListener('keyup', (event) => event.key === 'Enter' && released());
    });
    addEventListener('hashchange', () => this.open());
    for (const kind of ['blur', 'pagehide']) addEventListener(kind, () => this.endJog());
    document.addEventListener('visibilitychange', () => document.hidden && this.endJog());
  }

  /** Sends the token, after each new connection. The token moves from the address, which others may see, into the state of the tab. */
  open() {
    this.endJog();
    const given = new URLSearchParams(location.hash.slice(1)).get('token');
    if (given !== null) history.replaceState({token: given}, '', location.pathname + location.search);
    const token = history.state?.token;
    this.unlock(false);
    if (token !== undefined) this.send({action: 'open', token});
  }

  unlock(open) {
    this.panel.hidden = !open;
    this.locked.hidden = open;
  }

  send(order) {
    if (this.connection.send({op: 'act', ...order})) return true;
    this.answer('nothing was sent: there is no connection to strainwave-telemetry; use the emergency stop', true);
    return false;
  }

  quote(joint) {
    return {joint: joint.channel, session_id: joint.last.session_id, challenge: joint.last.challenge};
  }

  order(action) {
    const joint = this.bench.joints().get(this.bench.chosen());
    if (joint) this.send({action, ...this.quote(joint)});
  }

  stop() {
    this.endJog();
    if (!this.send({action: 'stop'})) return;
    this.stopTimer ??= setTimeout(() => {
      this.stopTimer = null;
      this.answer('no answer to the stop; use the emergency stop', true);
    }, STOP_ANSWER_MS);
  }

  speed_rad_s(joint) {
    return joint.limits ? this.jogShare * joint.limits.speed_limit_rad_s * (Number(this.speed.value) / 100) : 0;
  }

  jog(sign, button) {
    this.endJog();
    const name = this.bench.chosen();
    const joint = this.bench.joints().get(name);
    if (!joint?.limits) return;
    const jogging = {button, number: ++this.jogs, velocity_rad_s: sign * this.speed_rad_s(joint)};
    const repeat = () => {
      if (this.bench.chosen() !== name) return this.endJog();
      if (!this.send({action: 'jog', jog: jogging.number, velocity_rad_s: jogging.velocity_rad_s, ...this.quote(joint)})) this.endJog();
    };
    jogging.timer = setInterval(repeat, REPEAT_MS);
    this.jogging = jogging;
    repeat();
  }

  endJog() {
    if (this.jogging === null) return;
    const {number, timer} = this.jogging;
    clearInterval(timer);
    this.jogging = null;
    this.send({action: 'jog-end', jog: number});
  }

  /** Takes a message of the server. */
  take(message) {
    if (message.op === 'acting') {
      this.jogShare = message.jog_speed_share;
      this.unlock(message.open);
      this.show();
    } else if (message.op === 'acted') {
      clearTimeout(this.stopTimer);
      this.stopTimer = null;
      this.answer(message.text, message.refused);
    }
  }

  answer(text, refused) {
    this.answers.prepend(make('li', {textContent: text, className: refused ? 'fault' : ''}));
    while (this.answers.children.length > KEPT_ANSWERS) this.answers.lastChild.remove();
  }

  /** Shows the possible orders for the chosen joint. */
  show() {
    const name = this.bench.chosen();
    const joint = this.bench.joints().get(name);
    this.title.textContent = joint ? `Commands to ${name}` : 'Commands';
    for (const button of [this.enableButton, this.holdButton]) button.disabled = !joint;
    for (const button of this.jogButtons) button.disabled = !joint?.limits;
    if (!joint?.limits) return;
    const {position_min_rad, position_max_rad, speed_limit_rad_s} = joint.limits;
    this.speedText.textContent = `${this.speed_rad_s(joint).toFixed(3)} rad/s`;
    this.range.textContent = `A jog stays between ${position_min_rad} and ${position_max_rad} rad, moves at ${Number((this.jogShare * speed_limit_rad_s).toPrecision(3))} rad/s at most, `
      + 'and lasts while its button, or Enter on it, is held.';
  }
}
