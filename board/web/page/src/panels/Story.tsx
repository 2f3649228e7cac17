import { useRef } from "preact/hooks";
import { Story as Told } from "../model/story";
import { useBoard } from "../ui/context";

/** What the selected robot's filter does not know yet, over the field. */
export function Story() {
  const board = useBoard(200);
  const told = useRef<{ robot: number; story: Told } | null>(null);
  const { robot } = board;
  if (told.current?.robot !== robot?.number) told.current = robot && { robot: robot.number, story: new Told() };
  const text = robot && told.current ? told.current.story.tell(robot, board.now) : "";
  return <p role="status" class={text ? "story" : "story none"}>{text}</p>;
}
