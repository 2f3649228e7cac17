/** Whether keys pressed at @p target are meant for it, as in a field of text, and not for the page. */
export function isTypedInto(target: EventTarget | null): boolean {
  const { tagName = "", type = "" } = (target ?? {}) as Partial<HTMLInputElement>;
  return /^(INPUT|SELECT|TEXTAREA)$/.test(tagName) && !/^(checkbox|radio)$/.test(type);
}
