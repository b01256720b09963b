/** What stands around a shape: a grid on the floor, and the axes. */

import { BufferAttribute, BufferGeometry, Color, Group, LineBasicMaterial, LineSegments, Vector3 } from "three";

/** Of the largest extent: between two lines of the grid. */
export const GRID_STEP = 0.1;
const REACH = 0.6;
export const AXES: readonly { name: string; end: Vector3; colour: string }[] = [
  { name: "x", end: new Vector3(REACH, 0, 0), colour: "#c4473a" },
  { name: "y", end: new Vector3(0, REACH, 0), colour: "#3f8f4f" },
  { name: "z", end: new Vector3(0, 0, REACH), colour: "#3a6fc4" },
];

export class Furniture {
  readonly group = new Group();
  private readonly net = new BufferGeometry();
  private readonly rods = new BufferGeometry();
  private readonly thread = new LineBasicMaterial({ transparent: true, opacity: 0.55 });
  private readonly paint = new LineBasicMaterial({ vertexColors: true });
  private readonly floor = new LineSegments(this.net, this.thread);

  constructor() {
    this.group.visible = false;
    this.net.setAttribute("position", new BufferAttribute(new Float32Array(grid()), 3));
    const ends = AXES.flatMap(({ end }) => [0, 0, 0, ...end.toArray()]);
    const colours = AXES.flatMap(({ colour }) => [colour, colour].flatMap((one) => new Color(one).toArray()));
    this.rods.setAttribute("position", new BufferAttribute(new Float32Array(ends), 3));
    this.rods.setAttribute("color", new BufferAttribute(new Float32Array(colours), 3));
    this.group.add(this.floor, new LineSegments(this.rods, this.paint));
  }

  /** floor: the height of the grid. */
  place(on: boolean, floor: number, ink: Color): void {
    this.group.visible = on;
    this.floor.position.y = floor;
    this.thread.color.copy(ink);
  }

  dispose(): void {
    for (const owned of [this.net, this.rods, this.thread, this.paint]) owned.dispose();
  }
}

function grid(): number[] {
  const steps = Math.round(REACH / GRID_STEP);
  return Array.from({ length: 2 * steps + 1 }, (_, i) => (i - steps) * GRID_STEP).flatMap((at) => [
    ...[at, 0, -REACH, at, 0, REACH],
    ...[-REACH, 0, at, REACH, 0, at],
  ]);
}
