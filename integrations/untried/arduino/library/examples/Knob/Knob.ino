// Never run on a board: a slider that feels like a needle. A potentiometer at A0 gives the depth, a motor driver at pin
// 9 takes the force. It has no safety limits: use a motor that cannot hurt a finger. The driver must stop without a PWM signal.
#include <Punctura.h>

using namespace punctura;

constexpr float period = 1 / 1000.0f;           // s
constexpr float travel = 20e-3f;                // m of the slider
constexpr float full_force = 2;                 // N of the motor at a duty of 255

Proxy1d<ThickLawF> skin(ThickLawF({1.08e-3f, 0.28f}, {570, 0.41f, 0.2f, 1e-3f}), {400, 1}, period);
unsigned long next_tick = 0;  // us

void setup() {
  pinMode(9, OUTPUT);
  pinMode(8, OUTPUT);
  next_tick = micros();
}

void loop() {
  if (static_cast<long>(micros() - next_tick) < 0) return;
  next_tick += 1000;
  const float depth = travel * (static_cast<float>(analogRead(A0)) / 1023 - 0.25f);
  const float force = skin.step(depth);  // NaN if depth is no number
  const float duty = force == force ? 255 * force / full_force : 0;
  digitalWrite(8, duty < 0 ? 1 : 0);  // the direction
  const float size = duty < 0 ? -duty : duty;
  analogWrite(9, static_cast<int>(size < 255 ? size : 255));
}
