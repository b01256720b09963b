// A planter with a pattern of ribs and a saucer: linear_extrude with scale and twist.
// shapewright: size=given

/* [Pot] */
// outer size of the rim, and height
size = [90, 80]; // [40:1:140]
// sides of its plan
sides = 6; // [4:12]
// size of the foot, as a share of the rim's
taper = 0.7; // [0.4:0.02:1]
// how far the rim is turned against the foot, in degrees
twist = 20; // [0:1:60]

/* [Details] */
wall = 4; // [2:0.5:8]
ribs = false;
// number of holes in the floor
holes = 3; // [0:5]
saucer = true;

/* [Hidden] */
$fn = 24;
rim = size[0] / 2;
height = size[1];

module plan(r) {
  circle(r = r, $fn = sides);
  if (ribs) for (i = [0 : sides - 1]) rotate(360 / sides * i) translate([r, 0]) circle(r = 0.12 * r, $fn = 10);
}

module twisted() linear_extrude(height, scale = 1 / taper, twist = twist, slices = 12) children();

module outside() twisted() plan(taper * rim);

module inside() intersection() {
  twisted() circle(r = taper * rim - wall, $fn = sides);
  translate([0, 0, wall + height]) cube([4 * rim, 4 * rim, 2 * height], center = true);
}

module drain() for (i = [0 : 1 : holes - 1])
  rotate(360 / holes * i) translate([0.45 * taper * rim, 0, -1]) cylinder(r = 3, h = wall + 2);

module pot() difference() {
  outside();
  inside();
  drain();
}

module dish() translate([0, 0, -wall]) difference() {
  cylinder(r = taper * rim + 12, h = wall + 8, $fn = 48);
  translate([0, 0, wall]) cylinder(r = taper * rim + 12 - wall, h = 20, $fn = 48);
}

pot();
if (saucer) dish();
