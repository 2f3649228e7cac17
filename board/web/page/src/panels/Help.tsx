import { useEffect, useRef } from "preact/hooks";
import { usePage } from "../ui/context";
import { kKeys } from "../ui/keys";

export function Help() {
  const { ui } = usePage();
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current!.showModal(), []);
  return (
    <dialog ref={dialog} class="help" aria-labelledby="help-title" onClose={() => ui.change({ isHelpOpen: false })}>
      <h2 id="help-title">Keys and mouse</h2>
      <dl>
        {kKeys.map(({ keys, about }) => (
          <div key={keys}>
            <dt><kbd>{keys}</kbd></dt>
            <dd>{about}</dd>
          </div>
        ))}
      </dl>
      <h3>On the field</h3>
      <ul>
        <li>Wheel or two fingers: larger, smaller. Drag the floor, or arrow keys: move.</li>
        <li>Click a robot to select it. Operators drag robots and balls; with <kbd>Alt</kbd> a robot turns.</li>
        <li><kbd>Shift</kbd> and drag: gives the filter the selected robot's approximate pose.</li>
        <li>With a map shown: click to see each feature's probability at a place.</li>
      </ul>
      <button class="primary" onClick={() => dialog.current!.close()}>Close</button>
    </dialog>
  );
}
