//! Values for what Mitsuba scenes leave open.

use crate::workplace::Workplace;

const OPEN: &str = r#"<scene version="3.0.0"><default name="radius" value="1"/>
<sensor type="perspective"><transform name="to_world"><lookat origin="0,0,5" target="0,0,0" up="0,1,0"/></transform>
<film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/></film></sensor>
<emitter type="constant"/><shape type="sphere"><float name="radius" value="$radius"/></shape></scene>"#;

#[test]
fn values_are_put_in_kept_and_checked() {
    let place = Workplace::new();
    place.write("open.xml", OPEN);
    place.done("render open.xml --spp 2 -o usual.png");
    place.done("render open.xml --spp 2 -D radius=0.5 -o small.png");
    assert_ne!(place.bytes("usual.png"), place.bytes("small.png"));
    // Whoever goes on with a film or makes a picture again need not say them again.
    assert!(place.done("reproduce small.png").out.starts_with("equal"));
    place.done("render open.xml --resume small.luch --spp 4 -o small.png");
    assert!(place.done("check open.xml -D radius=3 --json").out.contains("-3.0"));

    let said = place.fails("render open.xml --spp 2 -D radios=0.5 -o wrong.png", 1);
    assert!(said.err.contains("has no parameter \"radios\"") && said.err.contains("radius"), "{}", said.err);
    assert!(place.fails("check open.xml -D radius", 2).err.contains("NAME=VALUE"));
    let said = place.fails("check open.xml -D radius=1 -D radius=2", 2);
    assert!(said.err.contains("-D radius is given twice"), "{}", said.err);
    let said = place.fails("check scene.kdl -D radius=1", 1);
    assert!(said.err.contains("scene.kdl") && said.err.contains("has no parameter"), "{}", said.err);
}
