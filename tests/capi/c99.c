#include "c99.h"

#include <math.h>

punctura_scene* c99_scene(void) {
  punctura_setup setup;
  punctura_membrane membrane;
  punctura_scene* scene = NULL;
  if (!punctura_check_abi()) return NULL;
  if (punctura_setup_init(&setup, sizeof setup) != PUNCTURA_OK) return NULL;
  setup.name = "one membrane";
  setup.diameter = 1.08e-3;
  setup.tip_angle = 0.28;
  setup.stiffness = 400;
  setup.damping = 1;
  if (punctura_scene_new(&setup, &scene) != PUNCTURA_OK) return NULL;
  if (punctura_membrane_init(&membrane, sizeof membrane) != PUNCTURA_OK) return NULL;
  membrane.name = "wall";
  membrane.stiffness = 570;
  membrane.precompression = 0.41;
  membrane.friction = 0.2;
  membrane.thickness = 1e-3;
  membrane.point[0] = membrane.point[1] = membrane.point[2] = 0;
  membrane.inward_normal[0] = membrane.inward_normal[2] = 0;
  membrane.inward_normal[1] = -1;
  if (punctura_scene_add_membrane(scene, &membrane) != PUNCTURA_OK) return NULL;
  return scene;
}

int c99_push(const punctura_scene* scene, double* largest) {
  punctura_servo* servo = NULL;
  punctura_sample sample;
  punctura_record record;
  double rate = 0;
  int k, with_force = 0;
  if (punctura_scene_get(scene, "servo.rate", &rate) != PUNCTURA_OK) return -1;
  if (punctura_servo_new(scene, NULL, &servo) != PUNCTURA_OK) return -1;
  if (punctura_sample_init(&sample, sizeof sample) != PUNCTURA_OK) return -1;
  record.struct_size = sizeof record;
  *largest = 0;
  punctura_servo_arm(servo);
  for (k = 0; k < 2400; ++k) {
    sample.sequence = (uint64_t)k;
    sample.time = k / rate;
    sample.position[1] = 5e-3 - 10e-3 * sample.time;
    if (punctura_servo_step(servo, &sample, &record) != PUNCTURA_OK || record.fault != 0) return -1;
    with_force += record.force[1] > 0;
    *largest = fmax(*largest, record.force[1]);
  }
  punctura_servo_free(servo);
  return with_force;
}
