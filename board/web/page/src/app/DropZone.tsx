import { useEffect, useState } from "preact/hooks";
import { useBoard, usePage } from "../ui/context";

type Where = "alone" | "beside";

const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;

/** Files that are dropped anywhere on the page, or pasted, are opened. */
export function DropZone() {
  const board = useBoard(250);
  const { opening } = usePage();
  const [isOver, setOver] = useState(false);
  const [where, setWhere] = useState<Where>("alone");
  const canBeside = opening.isPossible && board.robots.size > 0 && !opening.isBusy;
  useEffect(() => {
    let depth = 0; // of elements that were entered and not left
    const placeOf = ({ clientX }: DragEvent): Where => (canBeside && clientX > innerWidth / 2 ? "beside" : "alone");
    const enter = (event: DragEvent) => {
      if (!hasFiles(event)) return;
      depth++;
      setOver(true);
    };
    const leave = (event: DragEvent) => {
      if (hasFiles(event) && --depth <= 0) setOver(false);
    };
    const over = (event: DragEvent) => {
      if (!hasFiles(event)) return;
      event.preventDefault(); // or the browser shows the file itself
      setWhere(placeOf(event));
    };
    const drop = (event: DragEvent) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      depth = 0;
      setOver(false);
      const { items, files } = event.dataTransfer!;
      const isFolder = [...items].some((item) => item.webkitGetAsEntry?.()?.isDirectory);
      if (isFolder) opening.fail("A folder can't be opened here: drop the .mcap or .db3 file in it");
      else void opening.open([...files], placeOf(event) === "beside");
    };
    const paste = (event: ClipboardEvent) => {
      const files = [...(event.clipboardData?.files ?? [])];
      if (files.length) void opening.open(files, false);
    };
    const all = { dragenter: enter, dragleave: leave, dragover: over, drop, paste };
    for (const [type, listener] of Object.entries(all)) window.addEventListener(type, listener as EventListener);
    return () => {
      for (const [type, listener] of Object.entries(all)) window.removeEventListener(type, listener as EventListener);
    };
  }, [opening, canBeside]);
  if (!isOver) return null;
  return (
    <div class="drop-zone" aria-hidden="true">
      <p class={where === "alone" ? "here" : ""}>Open it{canBeside && " alone"}<small>a record, an MCAP file, a bag, a CARMEN log</small></p>
      {canBeside && <p class={where === "beside" ? "here" : ""}>Open it beside {board.worldName}</p>}
    </div>
  );
}

/** How far a file is that is being opened, or why it can't be. */
export function OpeningNote() {
  useBoard(100);
  const { opening } = usePage();
  const { state } = opening;
  return (
    <>
      <div role="status" class={opening.isBusy ? "layout-note" : "layout-note none"}>
        {state.phase === "sending" && (
          <>
            <span>{state.name} is being sent</span>
            <progress max={1} value={state.share} aria-label="How much of the file was sent" />
            <button onClick={() => opening.cancel()}>Cancel</button>
          </>
        )}
        {state.phase === "reading" && (
          <>
            <span>{state.name} is being read</span>
            <progress aria-label="The file is being read" />
          </>
        )}
      </div>
      {state.phase === "failed" && (
        <p class="error opening" role="alert">
          {state.text}
          <button aria-label="Close" onClick={() => opening.forget()}>×</button>
        </p>
      )}
    </>
  );
}
