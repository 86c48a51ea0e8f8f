// Short names for elements of the page.

// The namespace of pictures.
export const SVG = "http://www.w3.org/2000/svg";

export const one = (query, within = document) => within.querySelector(query);

export const all = (query, within = document) => [...within.querySelectorAll(query)];

export function made(tag, properties, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

export function button(text, action) {
  const element = made("button", { type: "button", textContent: text });
  element.addEventListener("click", action);
  return element;
}
