//! The forces of the crate equal those of the core, bit for bit. REFERENCE: a folder of integrations/reference.py.

use punctura::{fault_text, Insertion, Sample, Scene, Servo, Triple};
use std::path::PathBuf;

fn reference() -> PathBuf {
    PathBuf::from(std::env::var("REFERENCE").expect("run integrations/rust/test.sh"))
}

fn scene_text() -> String {
    std::fs::read_to_string(reference().join("scene.toml")).unwrap()
}

/// Position, axis and force of each tick.
fn rows() -> Vec<[Triple; 3]> {
    let bytes = std::fs::read(reference().join("motion.f64")).unwrap();
    let numbers: Vec<f64> = bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect();
    let triple = |v: &[f64]| [v[0], v[1], v[2]];
    numbers.chunks_exact(9).map(|r| [triple(&r[0..3]), triple(&r[3..6]), triple(&r[6..9])]).collect()
}

fn bits(force: Triple) -> [u64; 3] {
    force.map(f64::to_bits)
}

#[test]
fn the_forces_are_those_of_the_core_stepped_peeked_and_restored() {
    let scene = Scene::from_toml(&scene_text()).unwrap();
    let (mut stepped, mut peeked) = (Insertion::new(&scene).unwrap(), Insertion::new(&scene).unwrap());
    let rows = rows();
    assert_eq!(rows.len(), 4000);
    let mut kept = Vec::new();
    for (i, [position, axis, force]) in rows.iter().enumerate() {
        if i == 2000 {
            kept = stepped.state().unwrap();
        }
        assert_eq!(bits(stepped.step(*position, *axis)), bits(*force), "tick {i}");
        peeked.peek([1.0, 2.0, 3.0], *axis);
        assert_eq!(bits(peeked.peek(*position, *axis)), bits(*force), "peeked tick {i}");
        peeked.commit().unwrap();
    }
    stepped.restore(&kept).unwrap();
    for [position, axis, force] in &rows[2000..] {
        assert_eq!(bits(stepped.step(*position, *axis)), bits(*force));
    }
    assert!(stepped.membrane(0).upper >= stepped.membrane(0).lower);
    assert!(stepped.step([f64::NAN, 0.0, 0.0], [0.0, -1.0, 0.0])[0].is_nan());
    assert!(stepped.restore(&kept[1..]).unwrap_err().text.contains("bytes"));
    assert!(peeked.commit().unwrap_err().text.contains("no tick to commit")); // not the older error
}

#[test]
fn the_same_scene_comes_from_lines() {
    let lines = std::fs::read_to_string(reference().join("scene.txt")).unwrap();
    let mut insertion = Insertion::new(&Scene::from_values(&lines).unwrap()).unwrap();
    for [position, axis, force] in rows() {
        assert_eq!(bits(insertion.step(position, axis)), bits(force));
    }
}

#[test]
fn an_error_names_the_path() {
    let wrong = scene_text().replace("friction", "frictoin");
    assert!(Scene::from_toml(&wrong).err().unwrap().text.contains("membrane[0].frictoin"));
    let mut scene = Scene::from_toml(&scene_text()).unwrap();
    scene.set("membrane[0].friction", -1.0).unwrap();
    assert_eq!(scene.get("membrane[0].friction"), Ok(-1.0));
    assert!(Insertion::new(&scene).err().unwrap().text.contains("membrane[0].friction = -1"));
    assert!(scene.set_word("servo.solver", "fast").is_err());
    assert_eq!(scene.unusual(), "");
    scene.set("needle.diameter", 1.08).unwrap();
    assert!(scene.unusual().contains("If you meant 1.08 mm"));
}

#[test]
fn a_servo_gives_force_and_latches_a_fault() {
    let scene = Scene::from_toml(&scene_text()).unwrap();
    let mut servo = std::thread::spawn(move || {
        let mut servo = Servo::new(&scene).unwrap();
        servo.arm();
        servo
    })
    .join()
    .unwrap();
    let mut sample = Sample::healthy();
    let mut strongest = 0f64;
    for k in 0..1600u64 {
        sample.sequence = k;
        sample.time = k as f64 / 1600.0;
        sample.position = [0.0, 2e-3 - 9e-3 * sample.time, 0.0];
        strongest = strongest.max(servo.step(&sample).force[1]);
    }
    assert!(strongest > 0.5);
    sample.position[0] = f64::NAN;
    let record = servo.step(&sample);
    assert_eq!(record.force, [0.0; 3]);
    assert!(fault_text(record.fault).contains("not finite"));
}
