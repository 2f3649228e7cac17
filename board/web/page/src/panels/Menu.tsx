import type { ComponentChildren } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";

export interface MenuItem {
  text: string;
  /** Of an item that is on or off. */
  isChecked?: boolean;
  /** Whether a line stands above it. */
  beginsPart?: boolean;
  do(): void;
}

/** A button with a menu. Arrow keys and first letters go through it, Escape closes it. */
export function Menu({ label, children, items, class: kind = "" }: {
  label: string; children: ComponentChildren; items: MenuItem[]; class?: string;
}) {
  const [isOpen, setOpen] = useState(false);
  const button = useRef<HTMLButtonElement>(null);
  return (
    <>
      <button
        ref={button}
        class={kind}
        aria-haspopup="menu"
        aria-expanded={isOpen}
        aria-label={label}
        title={label}
        onClick={() => setOpen(!isOpen)}
        onKeyDown={(event) => {
          if (event.key !== "ArrowDown" || isOpen) return;
          event.preventDefault();
          setOpen(true);
        }}
      >
        {children}
      </button>
      {isOpen && <Items label={label} items={items} button={button.current!} onClose={() => setOpen(false)} />}
    </>
  );
}

/** Below the button, or wherever it fits into the window. */
function place(menu: HTMLElement, button: HTMLElement): void {
  const at = button.getBoundingClientRect();
  const { width, height } = menu.getBoundingClientRect();
  const below = at.bottom + 2;
  const top = below + height <= innerHeight ? below : Math.max(4, at.top - height - 2);
  menu.style.top = `${top}px`;
  menu.style.left = `${Math.max(4, Math.min(at.left, innerWidth - width - 4))}px`;
}

function Items({ label, items, button, onClose }: {
  label: string; items: MenuItem[]; button: HTMLButtonElement; onClose(): void;
}) {
  const menu = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    place(menu.current!, button);
    menu.current!.querySelector("button")?.focus();
  }, [button]);
  useEffect(() => {
    const elsewhere = ({ target }: Event) => {
      if (!menu.current?.contains(target as Node) && !button.contains(target as Node)) onClose();
    };
    window.addEventListener("pointerdown", elsewhere, true);
    return () => window.removeEventListener("pointerdown", elsewhere, true);
  }, [button, onClose]);
  const go = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    event.stopPropagation(); // the page's keys are not the menu's
    if (event.key === "Tab") return onClose();
    const all = [...menu.current!.querySelectorAll("button")];
    const at = all.indexOf(document.activeElement as HTMLButtonElement);
    const letter = event.key.toLowerCase();
    const to = {
      ArrowDown: (at + 1) % all.length, ArrowUp: (at - 1 + all.length) % all.length, Home: 0, End: all.length - 1,
    }[event.key] ?? (letter.length === 1 && letter !== " "
      ? [...all.keys()].map((i) => (at + 1 + i) % all.length).find((i) => items[i]!.text.toLowerCase().startsWith(letter)) : undefined);
    if (event.key === "Escape") {
      onClose();
      button.focus();
    } else if (to !== undefined) {
      all[to]!.focus();
    } else {
      return;
    }
    event.preventDefault();
  };
  return (
    <div ref={menu} class="menu" role="menu" aria-label={label} onKeyDown={go}>
      {items.map(({ text, isChecked, beginsPart, do: act }) => (
        <button
          key={text}
          role={isChecked === undefined ? "menuitem" : "menuitemcheckbox"}
          aria-checked={isChecked}
          tabIndex={-1}
          class={beginsPart ? "part" : ""}
          onClick={() => {
            onClose();
            act();
            // What was done may have taken the button away.
            if (button.isConnected) button.focus();
          }}
        >
          {text}
        </button>
      ))}
    </div>
  );
}
