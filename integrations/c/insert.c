/* Pushes a needle through the first membrane of a scene and prints the force.
 *
 *   insert SCENE.toml        a scene file, for example python/punctura/ready_scenes/k06-fig12.toml
 */
#include <punctura.h>
#include <stdio.h>
#include <stdlib.h>

/* Reads a whole file. Returns NULL if that fails. */
static char* read_file(const char* path, size_t* size) {
  FILE* file = fopen(path, "rb");
  char* text = malloc(1 << 20);
  if (!file || !text) return NULL;
  *size = fread(text, 1, 1 << 20, file);
  fclose(file);
  return text;
}

int main(int argc, char** argv) {
  size_t size = 0;
  char* text = argc == 2 ? read_file(argv[1], &size) : NULL;
  punctura_scene* scene = NULL;
  punctura_insertion* insertion = NULL;
  double rate;
  int k;
  if (!text) {
    fprintf(stderr, "usage: insert SCENE.toml\n");
    return 2;
  }
  if (!punctura_check_abi()) {
    fprintf(stderr, "punctura.h and libpunctura %s do not fit together\n", punctura_version());
    return 1;
  }
  if (punctura_scene_from_toml(text, size, &scene) != PUNCTURA_OK ||
      punctura_insertion_new(scene, &insertion) != PUNCTURA_OK) {
    fprintf(stderr, "%s\n", punctura_last_error());
    return 1;
  }
  fputs(punctura_scene_unusual(scene), stderr); /* a number in a wrong unit, if there is one */
  punctura_scene_get(scene, "servo.rate", &rate);
  for (k = 0; k <= (int)rate; ++k) { /* one second at 10 mm/s, straight down */
    const double position[3] = {0, 1e-3 - 10e-3 * k / rate, 0}, axis[3] = {0, -1, 0};
    double force[3];
    punctura_insertion_step(insertion, position, axis, force);
    if (k % (int)(rate / 20) == 0) printf("%6.2f mm  %7.4f N\n", -1e3 * position[1], force[1]);
  }
  punctura_insertion_free(insertion);
  punctura_scene_free(scene);
  free(text);
  return 0;
}
