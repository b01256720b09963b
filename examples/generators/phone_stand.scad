// A stand for a phone: hulls between rods, a lip in front and a hole for the cable.
// shapewright: size=given

/* [Phone] */
// width of the stand
width = 70; // [40:1:110]
// how far the phone leans back, in degrees
lean = 65; // [45:1:80]
// depth of the slot
slot = 14; // [8:0.5:24]

/* [Stand] */
back = 100; // [60:1:150]
lip = 12; // [5:0.5:25]
thickness = 5; // [3:0.5:9]
// what holds up the back
support = "legs"; // [plate:Plate, legs:Two legs, arch:Arch]
// hole for the cable
cable = true;

/* [Hidden] */
$fn = 24;
top = [back * cos(lean), 0, back * sin(lean)];
foot = [back * cos(lean) + 0.35 * back, 0, 0];

module rod(at, long = width)
  translate(at + [0, -long / 2, thickness / 2]) rotate([-90, 0, 0]) cylinder(d = thickness, h = long);

module panel(from, to, long = width) hull() {
  rod(from, long);
  rod(to, long);
}

module rest() difference() {
  union() {
    panel([0, 0, 0], top);
    panel([-slot, 0, 0], [0, 0, 0]);
    panel([-slot, 0, 0], [-slot - lip * cos(lean) / 2, 0, lip]);
  }
  if (cable) translate([-slot / 2, 0, -1]) cylinder(d = min(12, slot), h = 4 * thickness, center = true);
}

module leg(side) translate([0, side * (width - 12) / 2, 0]) panel(top, foot, 12);

module prop() {
  if (support == "plate") panel(top, foot);
  if (support == "legs") for (side = [-1, 1]) leg(side);
  if (support == "arch") difference() {
    panel(top, foot);
    translate([foot[0] - 0.1 * back, 0, 0]) rotate([0, 90, 0]) scale([0.9, 0.35, 1])
      cylinder(r = width, h = back, center = true, $fn = 48);
  }
  panel([0, 0, 0], foot, support == "plate" ? width : 12);
}

rest();
prop();
