// What an arrow key moves in the scene, and how far.
import type { Point } from "./engine.js";

/** (m) of an arrow key. */
const STEP = 0.05;

const DIRECTIONS: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** Right and up; nothing where it is another key. */
export const arrowOf = (event: KeyboardEvent): Point | undefined => DIRECTIONS[event.key];

/** How many steps a press is: more with Shift, a part of one with Alt. */
export const stepsOf = (event: KeyboardEvent): number => (event.shiftKey ? 5 : event.altKey ? 0.2 : 1);

/** A place moved by so many steps. */
export const stepped = ([x, y]: Point, [right, up]: Point, steps: number): Point => [x + right * STEP * steps, y + up * STEP * steps];
