// A box for tools with compartments, feet, and a handle to carry it.
// shapewright: size=given

/* [Tray] */
length = 160; // [80:1:240]
width = 90; // [50:1:150]
height = 40; // [20:1:80]
wall = 2.5; // [1.5:0.25:5]

/* [Inside] */
columns = 3; // [1:5]
rows = 2; // [1:3]

/* [Outside] */
// radius of the upright edges
corner = 8; // [2:0.5:15]
handle = "bridge"; // [none, bridge, ears]
feet = true;

/* [Hidden] */
$fn = 32;

module block(l, w, h, r) linear_extrude(h) offset(r = r) square([l - 2 * r, w - 2 * r], center = true);

module tray() {
  difference() {
    block(length, width, height, corner);
    translate([0, 0, wall]) block(length - 2 * wall, width - 2 * wall, height, max(corner - wall, 0.5));
  }
}

module dividers() {
  for (i = [1 : 1 : columns - 1])
    translate([-length / 2 + i * length / columns - wall / 2, -width / 2 + wall / 2, wall / 2])
      cube([wall, width - wall, height - wall / 2 - 3]);
  for (i = [1 : 1 : rows - 1])
    translate([-length / 2 + wall / 2, -width / 2 + i * width / rows - wall / 2, wall / 2])
      cube([length - wall, wall, height - wall / 2 - 3]);
}

module bridge() {
  for (side = [-1, 1]) translate([side * (length / 2 - wall), 0, height / 2]) rotate([0, 90, 0])
    linear_extrude(2 * wall, center = true) hull() {
      square([height, 30], center = true);
      translate([-height / 2 - 35, 0]) circle(r = 8);
    }
  translate([0, 0, height + 35]) rotate([0, 90, 0]) cylinder(r = 5, h = length - wall, center = true);
}

module ears() for (side = [-1, 1]) translate([side * length / 2, 0, height - 6]) difference() {
  resize([40, 46, 6]) cylinder(r = 20, h = 6);
  translate([side * 8, 0, -1]) resize([10, 22, 8]) cylinder(r = 8, h = 8);
  translate([-side * (25 + wall / 2), 0, 0]) cube([50, 80, 30], center = true);
}

module foot() cylinder(r1 = 5, r2 = 7, h = 6);

tray();
dividers();
if (handle == "bridge") bridge();
if (handle == "ears") ears();
if (feet) for (x = [-1, 1], y = [-1, 1])
  translate([x * (length / 2 - 12), y * (width / 2 - 12), -5]) foot();
