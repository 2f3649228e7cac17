import { useBoard } from "../ui/context";
import type { Robot } from "../model/Robot";
import { seconds, Section } from "./parts";

/** What records hold: their length, and each feature with how many readings it has. */
export function Contents() {
  const board = useBoard(500);
  const robots = [...board.robots.values()].filter(({ contents }) => contents.length > 0);
  return (
    <>
      {robots.map((robot) => <ContentsOf key={robot.number} robot={robot} />)}
    </>
  );
}

function ContentsOf({ robot }: { robot: Robot }) {
  const { contents, way } = robot;
  const length = Math.max(...contents.map(({ last }) => last));
  const readings = contents.reduce((sum, one) => sum + one.readings, 0);
  const poses = way && [
    ...(way.truth.length ? ["true poses"] : []),
    ...(way.estimate.length ? ["estimates"] : []),
    ...(way.odometry.length ? ["odometry"] : []),
  ];
  return (
    <Section title={`What ${robot.label} holds`}>
      <dl class="facts">
        <dt>length</dt>
        <dd>{seconds(length)}</dd>
        <dt>readings</dt>
        <dd>{readings} of {contents.length} features</dd>
        <dt>poses</dt>
        <dd>{poses?.join(", ") || (poses ? "none: robots stay where they are not known to be" : "…")}</dd>
      </dl>
      <table class="values contents">
        <thead>
          <tr>
            <th scope="col">feature</th>
            <th scope="col">readings</th>
            <th scope="col">a second</th>
          </tr>
        </thead>
        <tbody>
          {contents.map(({ feature, readings: count, first, last }) => (
            <tr key={feature}>
              <th scope="row">{feature}</th>
              <td>{count}</td>
              <td>{count > 1 && last > first ? (((count - 1) * 1e6) / (last - first)).toFixed(1) : "–"}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </Section>
  );
}
