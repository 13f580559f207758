// SPDX-License-Identifier: BSD-3-Clause
// Elements of the page.

export const make = (tag, properties = {}, ...children) => {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
};
