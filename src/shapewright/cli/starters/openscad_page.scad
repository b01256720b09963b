// A first procedure in OpenSCAD: what the Customizer shows is the parameter space.

/* [Size] */
// outer width [mm]
width = 80; // [40:160]
// outer depth [mm]
depth = 60; // [30:120]
height = 30; // [10:0.5:60]

/* [Inside] */
// wall thickness [mm]
wall = 2; // [1:0.2:4]
// number of compartments
compartments = 2; // [1:6]

/* [Lid] */
lid = "knob"; // [none:No lid, flat:Flat lid, knob:Lid with knob]

/* [Hidden] */
$fn = 32;

module tray() {
  difference() {
    translate([-width / 2, -depth / 2, 0]) cube([width, depth, height]);
    translate([-width / 2 + wall, -depth / 2 + wall, wall]) cube([width - 2 * wall, depth - 2 * wall, height]);
  }
  for (i = [1 : 1 : compartments - 1])
    translate([-width / 2 + i * width / compartments - wall / 2, -depth / 2, 0]) cube([wall, depth, height]);
}

module cover() {
  translate([-width / 2, -depth / 2, height]) cube([width, depth, wall]);
  if (lid == "knob") translate([0, 0, height + wall]) cylinder(d = 12, h = 10);
}

color("tan") tray();
if (lid != "none") color("red") cover();
