//! Pushes a needle through the membranes of a scene file and prints the force: cargo run --example insert SCENE.toml

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("usage: insert SCENE.toml")?;
    let scene = punctura::Scene::from_toml(&std::fs::read_to_string(path)?)?;
    let rate = scene.get("servo.rate")?;
    let mut insertion = punctura::Insertion::new(&scene)?;
    for k in 0..=rate as u32 {
        let y = 1e-3 - 10e-3 * f64::from(k) / rate;
        let force = insertion.step([0.0, y, 0.0], [0.0, -1.0, 0.0]);
        if k % 80 == 0 {
            println!("{:6.2} mm  {:7.4} N", -1e3 * y, force[1]);
        }
    }
    Ok(())
}
