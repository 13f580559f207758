// SPDX-License-Identifier: BSD-3-Clause
// Reports of commissioning and of the doctor. Lists of objects in JSON become tables. The tables, texts and pictures of a report.html are
// rebuilt, with every text as plain text. So nothing in the file can run, refer to another file, or replace elements of the page.

import {make} from './dom.js';

const MOST_ROWS = 1000;

const isObject = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);
const words = (key) => key.replaceAll('_', ' ');

function textOf(value) {
  if (value === null) return '–';
  if (typeof value === 'number') return String(Number(value.toPrecision(6)));
  if (Array.isArray(value)) return value.map(textOf).join('; ');
  if (isObject(value)) return Object.entries(value).map(([key, part]) => `${words(key)}: ${textOf(part)}`).join('; ');
  return String(value);
}

function tableOf(title, list) {
  const columns = [...new Set(list.flatMap((entry) => Object.keys(entry)))];
  const head = columns.map((column) => make('th', {scope: 'col'}, words(column)));
  const rows = list.slice(0, MOST_ROWS).map((entry) => make('tr', {}, ...columns.map((column) => make('td', {}, column in entry ? textOf(entry[column]) : ''))));
  const scroll = make('div', {className: 'scroll report', tabIndex: 0}, make('table', {}, make('caption', {}, words(title)), make('thead', {}, make('tr', {}, ...head)), make('tbody', {}, ...rows)));
  scroll.setAttribute('role', 'region');
  scroll.setAttribute('aria-label', words(title));
  return scroll;
}

const HTML_ELEMENTS = {h1: 'h3', h2: 'h4', p: 'p', pre: 'pre', table: 'table', tbody: 'tbody', tr: 'tr', th: 'th', td: 'td'};
const SVG_ELEMENTS = ['svg', 'title', 'g', 'path', 'circle', 'text'];
const SVG_ATTRIBUTES = ['viewBox', 'role', 'class', 'd', 'x', 'y', 'cx', 'cy', 'r', 'transform', 'text-anchor'];
const SVG = 'http://www.w3.org/2000/svg';

function copyOf(node) {
  if (node.nodeType === Node.TEXT_NODE) return node.data;
  const isSvg = node.namespaceURI === SVG && SVG_ELEMENTS.includes(node.localName);
  if (!isSvg && !Object.hasOwn(HTML_ELEMENTS, node.localName)) return '';
  const copy = isSvg ? document.createElementNS(SVG, node.localName) : document.createElement(HTML_ELEMENTS[node.localName]);
  for (const {name, value} of node.attributes) if (isSvg && SVG_ATTRIBUTES.includes(name)) copy.setAttribute(name, value);
  copy.append(...[...node.childNodes].map(copyOf));
  return copy;
}

function readHtml(name, text) {
  const page = new DOMParser().parseFromString(text, 'text/html');
  if (!page.title.startsWith('Commissioning of ')) throw new Error(`${name}: not a report; the report.html of a commissioning is expected`);
  const scroll = make('div', {className: 'scroll report', tabIndex: 0}, ...[...page.body.childNodes].map(copyOf));
  scroll.setAttribute('role', 'region');
  scroll.setAttribute('aria-label', page.title);
  return [scroll];
}

/** The report in `text`, a file called `name`, as elements. Throws Error with a text for the user. */
export function readReport(name, text) {
  if (/\.html$/i.test(name)) return readHtml(name, text);
  const expected = `${name}: not a report; a JSON file of strainwavectl doctor --json or of a commissioning is expected`;
  let report;
  try {
    report = JSON.parse(text);
  } catch {
    throw new Error(expected);
  }
  const isTable = ([, value]) => Array.isArray(value) && value.length > 0 && value.every(isObject);
  if (!isObject(report)) throw new Error(expected);
  const entries = Object.entries(report);
  // The report of a healthy joint has an empty list.
  if (!entries.some(([, value]) => Array.isArray(value))) throw new Error(expected);
  const isFile = ([, value]) => typeof value === 'string' && value.includes('\n');
  const facts = entries.filter((entry) => !isTable(entry) && !isFile(entry)).map(([key, value]) => `${words(key)}: ${textOf(value) || 'none'}`);
  return [make('p', {}, facts.join(' · ')), ...entries.filter(isTable).map(([key, list]) => tableOf(key, list)),
    ...entries.filter(isFile).map(([key, value]) => make('details', {}, make('summary', {}, words(key)), make('pre', {}, value)))];
}
