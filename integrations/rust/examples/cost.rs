//! The time of a tick from Rust: cargo run --release --example cost REFERENCE

use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::path::PathBuf::from(std::env::args().nth(1).ok_or("usage: cost REFERENCE")?);
    let scene = punctura::Scene::from_toml(&std::fs::read_to_string(folder.join("scene.toml"))?)?;
    let mut insertion = punctura::Insertion::new(&scene)?;
    let bytes = std::fs::read(folder.join("motion.f64"))?;
    let rows: Vec<f64> = bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect();
    let (mut best, mut sum) = (f64::INFINITY, 0.0);
    for _ in 0..100 {
        insertion.reset();
        let start = Instant::now();
        for r in rows.chunks_exact(9) {
            sum += insertion.step([r[0], r[1], r[2]], [r[3], r[4], r[5]])[1];
        }
        best = best.min(start.elapsed().as_secs_f64());
    }
    assert!(sum != 0.0);
    println!("Rust: Insertion::step\t{:.1}", 1e9 * best / (rows.len() / 9) as f64);
    Ok(())
}
