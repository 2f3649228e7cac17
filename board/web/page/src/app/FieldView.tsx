import { useEffect, useRef, useState } from "preact/hooks";
import { FieldPainter } from "../field/FieldPainter";
import { robotColour } from "../field/palette";
import { Seen } from "../field/View";
import { FieldLegend } from "../panels/FieldLegend";
import { Icon } from "../panels/Icon";
import { Story } from "../panels/Story";
import { lazyScene3d } from "../scene/lazy";
import type { Scene3dHandle } from "../scene/Scene3d";
import { areApart, canBeApart } from "../ui/apart";
import { usePage, useBoard } from "../ui/context";
import { kLayerNames, kLayers } from "../ui/layers";

/** The field with its buttons; drawing itself is FieldPainter's, outside of Preact. */
// What is loaded when it is asked for is not in a page that stands alone.
const isExported = document.getElementById("run") !== null;

export function FieldView() {
  const context = usePage();
  const { ui, session } = context;
  const board = useBoard(200);
  const painters = useRef(new Set<FieldPainter>());
  const seen = useRef(new Seen());
  const [problem, setProblem] = useState("");
  const isApart = areApart(board, ui);
  const robots = [...board.robots.values()];
  useEffect(() => view()?.fit(), [board.worldName]);
  const view = () => [...painters.current][0];
  const stage = (only: number | null) => (
    <Stage only={only} seen={seen.current} painters={painters.current} onProblem={setProblem} />
  );
  return (
    <div class={isApart ? "field apart" : "field"}>
      {isApart ? (
        <div class={`fields many-${robots.length}`} hidden={ui.is3d}>
          {robots.map((robot) => (
            <section key={robot.number} class="one" aria-label={`Field of ${robot.label}`}>
              <button
                class="whose"
                aria-pressed={board.selected === robot.number}
                style={{ "--run": robotColour(robot, true) }}
                onClick={() => session.select(robot.number)}
              >
                {robot.label}
              </button>
              {stage(robot.number)}
            </section>
          ))}
        </div>
      ) : (
        <div class="fields" hidden={ui.is3d}>{stage(null)}</div>
      )}
      {ui.is3d && <Scene3d />}
      {!isApart && <Story />}
      <FieldLegend />
      {problem && <p class="error on-field" role="alert">{problem}</p>}
      <div class="tools left" role="toolbar" aria-label="View">
        <button title="Larger (+)" aria-label="Larger" onClick={() => view()?.zoomBy(1.3)}><Icon name="plus" /></button>
        <button title="Smaller (-)" aria-label="Smaller" onClick={() => view()?.zoomBy(1 / 1.3)}><Icon name="minus" /></button>
        <button title="Whole field (0)" aria-label="Whole field" onClick={() => view()?.fit()}><Icon name="fit" /></button>
        <button
          title="Follow the selected robot (f)"
          aria-label="Follow the selected robot"
          aria-pressed={ui.follow}
          onClick={() => ui.change({ follow: !ui.follow })}
        >
          <Icon name="follow" />
        </button>
        <button
          title="Measure (m)"
          aria-label="Measure"
          aria-pressed={ui.tool === "measure"}
          onClick={() => ui.change({ tool: ui.tool === "measure" ? "look" : "measure" })}
        >
          <Icon name="measure" />
        </button>
        {canBeApart(board) && (
          <button
            title="Runs side by side, or upon each other"
            aria-label="Side by side"
            aria-pressed={isApart}
            onClick={() => ui.change({ isOneField: isApart, is3d: false })}
          >
            <Icon name="apart" />
          </button>
        )}
        {!isExported && (
          <button
            title="The same in three dimensions (v)"
            aria-label="3D view"
            aria-pressed={ui.is3d}
            class="word"
            onClick={() => ui.change({ is3d: !ui.is3d })}
          >
            3D
          </button>
        )}
      </div>
      <details class="tools right layers">
        <summary>Layers</summary>
        <div role="group" aria-label="Layers">
          {kLayerNames.map((name) => (
            <label key={name} title={kLayers[name].about}>
              <input
                type="checkbox"
                checked={ui.layers[name]}
                onChange={(event) => ui.change({ layers: { ...ui.layers, [name]: event.currentTarget.checked } })}
              />
              {kLayers[name].label}
            </label>
          ))}
          {ui.layers.ghost && (
            <button onClick={() => { board.robot?.joinOdometry(); ui.redraw(); }}>Odometry starts here</button>
          )}
          {ui.layers.expected && board.link === "open" && !board.can("WHY") && (
            <p class="hint">This server does not report expected readings.</p>
          )}
        </div>
      </details>
      {session.board.errors.get("field") && (
        <p class="error on-field" role="alert">
          {session.board.errors.get("field")}
          <button
            aria-label="Close"
            onClick={() => {
              board.errors.delete("field");
              board.touch();
            }}
          >
            ×
          </button>
        </p>
      )}
    </div>
  );
}

/** One field, drawn by a FieldPainter. */
function Stage({ only, seen, painters, onProblem }: {
  only: number | null; seen: Seen; painters: Set<FieldPainter>; onProblem(text: string): void;
}) {
  const context = usePage();
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const made = new FieldPainter(place.current!, context, only, seen);
    painters.add(made);
    onProblem(made.problem);
    return () => {
      painters.delete(made);
      made.stop();
    };
  }, [context, only]);
  return <div class="stage2d" ref={place} />;
}

function Scene3d() {
  const context = usePage();
  const place = useRef<HTMLDivElement>(null);
  const [problem, setProblem] = useState("");
  useEffect(() => {
    let handle: Scene3dHandle | null = null;
    let isGone = false;
    lazyScene3d().then(
      ({ startScene3d }) => {
        if (!isGone && place.current) handle = startScene3d(place.current, context);
      },
      (error: unknown) => setProblem(`the 3-D view can't be shown: ${error instanceof Error ? error.message : error}`),
    );
    return () => {
      isGone = true;
      handle?.stop();
    };
  }, [context]);
  return (
    <div class="stage3d" ref={place}>
      {problem && <p class="error on-field" role="alert">{problem}</p>}
    </div>
  );
}
