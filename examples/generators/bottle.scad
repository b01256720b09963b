// A bottle with a neck, something that closes it, and a handle: rotate_extrude of an outline.
// shapewright: size=given

/* [Body] */
// height of the whole
height = 120; // [60:1:200]
// radius of the body
radius = 32; // [15:0.5:50]
// how much of the height is shoulder
shoulder = 0.25; // [0.1:0.01:0.5]

/* [Neck] */
// radius of the neck, as a share of the body's
neck = 0.4; // [0.2:0.02:0.8]
neck_height = 22; // [8:1:40]
// what closes it
closure = "cap"; // [none:Open, cap:Screw cap, cork:Cork]

/* [Handle] */
handle = false;

/* [Hidden] */
$fn = 48;
wall = 2;
body_height = height - neck_height;
neck_radius = neck * radius;

module outline() {
  low = body_height * (1 - shoulder);
  polygon([[0, 0], [radius - 3, 0], [radius, 3], [radius, low], [neck_radius, body_height],
           [neck_radius, height], [0, height]]);
}

module glass() {
  difference() {
    rotate_extrude() outline();
    if (closure == "none") translate([0, 0, wall]) rotate_extrude() offset(delta = -wall) outline();
    if (closure == "none") translate([0, 0, body_height]) cylinder(r = neck_radius - wall, h = height);
  }
}

module cap() {
  translate([0, 0, height - 12]) difference() {
    cylinder(r = neck_radius + 3, h = 15);
    for (i = [0 : 11]) rotate(30 * i) translate([neck_radius + 3.4, 0, -1]) cylinder(r = 1.2, h = 17, $fn = 8);
  }
}

module cork() {
  translate([0, 0, height - 1]) cylinder(r1 = neck_radius - 1, r2 = neck_radius + 1, h = 10);
}

module grip() difference() {
  translate([radius, 0, 0.42 * body_height]) rotate([90, 0, 0]) rotate_extrude($fn = 32)
    translate([0.22 * body_height, 0]) circle(r = 4, $fn = 12);
  cylinder(r = radius - 1, h = height);
}

glass();
if (closure == "cap") cap();
if (closure == "cork") cork();
if (handle) grip();
