// Makes and finds elements of the page.

export const byId = (id) => document.getElementById(id);

/** Makes an element. children: strings or elements. */
export function made(tag, properties, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

/** A button that calls `action`. Without an action, its content as text. */
export function link(properties, action, ...children) {
  if (!action) return made('span', properties, ...children);
  const button = made('button', { type: 'button', ...properties }, ...children);
  button.addEventListener('click', action);
  return button;
}

/** Shows the first `count` elements and a button for the others. */
export function shortened(elements, count, container, what) {
  container.append(...elements.slice(0, count));
  if (elements.length <= count) return [container];
  const more = link({ className: 'all' }, () => {
    container.append(...elements.slice(count));
    more.remove();
  }, `Show all ${elements.length.toLocaleString('en-US')} ${what}`);
  return [container, more];
}
