const kSpace = "http://www.w3.org/2000/svg";

export type Attributes = Record<string, string | number>;

export function make<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  parent?: Element,
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(kSpace, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  parent?.append(element);
  return element;
}

/** Sets an attribute only if it changed: reading one back costs less than a new layout. */
export function set(element: Element, name: string, value: string): void {
  if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}


export const fixed = (value: number, digits = 3): string => String(Number(value.toFixed(digits)));
