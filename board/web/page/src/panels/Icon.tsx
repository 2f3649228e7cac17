/** Drawn here, since fonts differ in which signs they have. On a grid of 16. */
const kPaths = {
  plus: "M8 3v10M3 8h10",
  minus: "M3 8h10",
  fit: "M2 6V2h4M10 2h4v4M14 10v4h-4M6 14H2v-4",
  follow: "M8 1v4M8 11v4M1 8h4M11 8h4M12 8a4 4 0 1 1-8 0a4 4 0 0 1 8 0",
  measure: "M1 8h14M4 5L1 8l3 3M12 5l3 3l-3 3",
  play: "M4 2.5L13 8L4 13.5z",
  pause: "M5 3v10M11 3v10",
  step: "M4 3L10 8L4 13zM13 3v10",
  auto: "M14 8A6 6 0 1 1 2 8a6 6 0 0 1 12 0M8 2v12M8 5h5M8 8h6M8 11h5",
  light: "M11 8a3 3 0 1 1-6 0a3 3 0 0 1 6 0M8 1v1.5M8 13.5V15M1 8h1.5M13.5 8H15M3 3l1 1M12 12l1 1M3 13l1-1M12 4l1-1",
  dark: "M13 10A6 6 0 1 1 6 3a5 5 0 0 0 7 7z",
  apart: "M1 3h6v10H1zM9 3h6v10H9z",
  panels: "M1 2.5h14v11H1zM10 2.5v11M10 8h5",
  more: "M3 8h.01M8 8h.01M13 8h.01",
  collapse: "M3 10.5L8 5.5l5 5",
  open: "M3 5.5l5 5l5-5",
  back: "M13 3H7M7 3v6M7 9L13 3M3 6v7h7",
  out: "M9 2h5v5M14 2L7 9M12 9v5H2V4h5",
  curve: "M1 11c3-9 4-9 7-3s4 6 7-3",
} as const;

export function Icon({ name }: { name: keyof typeof kPaths }) {
  return (
    <svg class={`icon ${name}`} viewBox="0 0 16 16" aria-hidden="true">
      <path d={kPaths[name]} />
    </svg>
  );
}
