// A spur gear on a hub: linear_extrude of an outline that a for loop makes.
// shapewright: size=given

/* [Teeth] */
// number of teeth
teeth = 18; // [14:40]
// pitch diameter divided by the number of teeth
modul = 2; // [1.5, 2, 2.5, 3]
width = 8; // [3:0.5:20]
// helix: how far the upper face is turned against the lower one, in degrees
twist = 0; // [0:1:30]

/* [Hub] */
bore = 6; // [3:0.5:10]
// how far the hub stands out of the wheel
hub = 6; // [0:0.5:15]
// what the web looks like
web = "spokes"; // [solid, holes, spokes]

/* [Hidden] */
$fn = 40;
pitch = teeth * modul / 2;
root = pitch - 1.25 * modul;
tip = pitch + modul;
rim = root - 2 * modul;
hub_radius = bore / 2 + 4;

assert(rim > hub_radius + 2, "the teeth are too few for the bore");

module tooth() {
  half = 90 / teeth;
  polygon([for (corner = [[root - 0.5, -1.5 * half], [root, -1.3 * half], [pitch, -half], [tip, -0.45 * half],
                          [tip, 0.45 * half], [pitch, half], [root, 1.3 * half], [root - 0.5, 1.5 * half]])
           corner[0] * [cos(corner[1]), sin(corner[1])]]);
}

module wheel() {
  linear_extrude(width, twist = twist, slices = twist > 0 ? 6 : 1) {
    circle(r = root, $fn = 2 * teeth);
    for (i = [0 : teeth - 1]) rotate(360 / teeth * i) tooth();
  }
}

module openings() {
  gap = rim - hub_radius;
  for (i = [0 : 5]) rotate(60 * i) {
    if (web == "holes") translate([hub_radius + gap / 2, 0, -1])
      cylinder(r = min(0.35 * gap, 0.4 * (hub_radius + gap / 2)), h = width + 2);
    if (web == "spokes") translate([0, 0, -1]) linear_extrude(width + 2) intersection() {
      difference() {
        circle(r = rim);
        circle(r = hub_radius + 0.1 * gap);
      }
      polygon([[0, 0], 2 * rim * [cos(15), sin(15)], 2 * rim * [cos(45), sin(45)]]);
    }
  }
}

module axle() translate([0, 0, -1]) cylinder(d = bore, h = width + hub + 2);

difference() {
  wheel();
  openings();
  axle();
}
if (hub > 0) difference() {
  cylinder(r = hub_radius, h = width + hub);
  axle();
}
