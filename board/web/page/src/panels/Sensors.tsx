import { useEffect, useRef, useState } from "preact/hooks";
import { putBack } from "../layout/moves";
import { useBoard, usePage } from "../ui/context";
import { pictureOf } from "../model/decode";
import type { Feature } from "../model/features";
import type { Robot } from "../model/Robot";
import { summary, valuesOf } from "../model/values";
import { Curves } from "./Curves";
import { Icon } from "./Icon";
import { Section } from "./parts";

export function SensorsPanel() {
  const board = useBoard(100);
  const [text, setText] = useState("");
  const { robot } = board;
  if (!robot) return <p class="hint">No robot is selected.</p>;
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  const found = robot.features.filter(({ name }) => words.every((word) => name.toLowerCase().includes(word)));
  return (
    <>
      <Curves />
      <Section title={`What ${robot.label} senses`}>
        <input
          type="search"
          placeholder="find by model, type or feature"
          aria-label="Find features"
          value={text}
          onInput={(event) => setText(event.currentTarget.value)}
        />
        {!found.length && <p class="hint">{robot.features.length ? "No feature has that name." : "It has no features."}</p>}
        <ul class="features">
          {found.map((feature) => (
            <FeatureItem key={feature.name} robot={robot} feature={feature} now={board.now} />
          ))}
        </ul>
      </Section>
    </>
  );
}

function FeatureItem({ robot, feature, now }: { robot: Robot; feature: Feature; now: number }) {
  const { session, ui } = usePage();
  const [isOpen, setOpen] = useState(false);
  const held = robot.readings.get(feature.name);
  const age = held ? Math.max(0, now - held.stamp) / 1e6 : null;
  const isPicture = feature.kind.name === "image";
  const values = isOpen && held ? valuesOf(feature.kind, held.words, 40) : [];
  const [model, type, name] = feature.name.split("/");
  useEffect(() => {
    if (!isPicture || !isOpen) return;
    session.wishes.pictures.add(feature.name);
    session.wish();
    return () => {
      session.wishes.pictures.delete(feature.name);
      session.wish();
    };
  }, [isPicture, isOpen, session, feature.name]);
  return (
    <li>
      <details open={isOpen} onToggle={(event) => setOpen(event.currentTarget.open)}>
        <summary title={feature.text}>
          <span class="who">
            <small>
              {model}/{type}/
            </small>
            {name}
          </span>
          <span class={age !== null && age > 1 ? "age old" : "age"}>{age === null ? "none yet" : `${age.toFixed(2)} s`}</span>
          <span class="reading">{held ? summary(feature.kind, held.words) : "–"}</span>
        </summary>
        {isOpen && isPicture && <CameraPicture words={held?.words ?? null} label={feature.name} />}
        {values.length > 0 && (
          <table class="values">
            <thead>
              <tr>
                <th scope="col">value</th>
                <th scope="col">reading</th>
                <th scope="col">curve</th>
              </tr>
            </thead>
            <tbody>
              {values.map(({ name: of, value, unit }, i) => (
                <tr key={i}>
                  <th scope="row">{of}</th>
                  <td>
                    {value.toFixed(Number.isInteger(value) && !unit ? 0 : 3)} {unit}
                  </td>
                  <td>
                    <button
                      aria-pressed={session.history.has(feature.name, of)}
                      aria-label={`Curve of ${of}`}
                      title="show over time"
                      onClick={() => {
                        session.history.toggle(feature.name, of, unit);
                        ui.change({ layout: putBack(ui.layout, `${feature.name} ${of}`) });
                      }}
                    >
                      <Icon name="curve" />
                    </button>
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
        )}
        {isOpen && <p class="hint">{feature.text}</p>}
      </details>
    </li>
  );
}

/** The newest picture of a camera, drawn as it lies in the reading. */
function CameraPicture({ words, label }: { words: Uint32Array | null; label: string }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const picture = words && pictureOf(words);
  useEffect(() => {
    if (!picture || !canvas.current) return;
    const { width, height, channels, pixels } = picture;
    canvas.current.width = width;
    canvas.current.height = height;
    const shown = new ImageData(width, height);
    for (let i = 0, from = 0, to = 0; i < width * height; ++i, from += channels, to += 4) {
      shown.data[to] = pixels[from]!;
      shown.data[to + 1] = pixels[channels === 3 ? from + 1 : from]!;
      shown.data[to + 2] = pixels[channels === 3 ? from + 2 : from]!;
      shown.data[to + 3] = 255;
    }
    canvas.current.getContext("2d")?.putImageData(shown, 0, 0);
  }, [words]);
  if (!picture) return <p class="hint">Waiting for the first picture …</p>;
  return <canvas ref={canvas} class="picture" role="img" aria-label={`picture of ${label}`} />;
}
