/* The C library in Octave and MATLAB. PuncturaInsertion.m calls it: punctura_mex(COMMAND, HANDLE, ...).
 *
 * A handle is a uint64 in Octave's memory: the number of a slot, so that a wrong one is refused. */
#include <mex.h>
#include <stdint.h>
#include <string.h>

#include "punctura.h"

enum { slots = 1024 };
static punctura_insertion* insertions[slots];

static void free_all(void) {
  int i;
  for (i = 0; i < slots; ++i) {
    punctura_insertion_free(insertions[i]);
    insertions[i] = NULL;
  }
}

/* At the end of the session the objects may be deleted after free_all(). */
static void free_one(double number) {
  if (!(number >= 0 && number < slots)) return;
  punctura_insertion_free(insertions[(int)number]);
  insertions[(int)number] = NULL;
}

static void check(punctura_status status) {
  if (status == PUNCTURA_OK) return;
  /* A tick keeps no text: the last error is then an older one. */
  const int older = status == PUNCTURA_NO_PEEK || status == PUNCTURA_NO_NUMBER || !*punctura_last_error();
  mexErrMsgIdAndTxt("punctura:error", "%s", older ? punctura_status_text(status) : punctura_last_error());
}

static void require(int holds, const char* text) {
  if (!holds) mexErrMsgIdAndTxt("punctura:argument", "%s", text);
}

static int slot_of(const mxArray* handle) {
  double number;
  require(mxIsDouble(handle) && mxGetNumberOfElements(handle) == 1, "the handle must be a number");
  number = mxGetScalar(handle);
  require(number >= 0 && number < slots && insertions[(int)number], "this insertion was deleted");
  return (int)number;
}

/* The numbers of a real double matrix with `rows` rows. */
static const double* matrix(const mxArray* array, size_t rows, const char* text) {
  require(mxIsDouble(array) && !mxIsComplex(array) && mxGetM(array) == rows, text);
  return mxGetPr(array);
}

static mxArray* new_insertion(const mxArray* text) {
  punctura_scene* scene = NULL;
  punctura_status status;
  int slot = 0;
  char* toml;
  require(mxIsChar(text), "the scene must be text");
  while (slot < slots && insertions[slot]) ++slot;
  require(slot < slots, "there are 1024 insertions: delete some");
  toml = mxArrayToString(text);
  status = punctura_scene_from_toml(toml, strlen(toml), &scene);
  mxFree(toml);
  check(status);
  status = punctura_insertion_new(scene, &insertions[slot]);
  punctura_scene_free(scene);
  check(status);
  return mxCreateDoubleScalar(slot);
}

/* P, A: 3 rows, a column a tick; A may have one column. Returns the forces, 3 rows. */
static mxArray* run(punctura_insertion* insertion, const mxArray* p, const mxArray* a) {
  const size_t count = mxGetN(p), axes = mxGetN(a);
  const double* positions = matrix(p, 3, "positions must be a real matrix with 3 rows, one column a tick");
  const double* directions = matrix(a, 3, "axes must be a real matrix with 3 rows");
  mxArray* forces = mxCreateDoubleMatrix(3, count, mxREAL);
  punctura_status status;
  require(axes == 1 || axes == count, "axes must have one column, or as many as the positions");
  status = punctura_insertion_run(insertion, count, positions, directions, axes == 1 ? 0 : 3, mxGetPr(forces));
  if (status != PUNCTURA_NO_NUMBER) check(status); /* NaN in, NaN out, as everywhere in this language */
  return forces;
}

static mxArray* one(punctura_insertion* insertion, const mxArray* p, const mxArray* a, int peek) {
  mxArray* force = mxCreateDoubleMatrix(3, 1, mxREAL);
  require(mxGetNumberOfElements(p) == 3 && mxGetNumberOfElements(a) == 3, "position and axis must have 3 numbers");
  require(mxIsDouble(p) && mxIsDouble(a) && !mxIsComplex(p) && !mxIsComplex(a), "position and axis must be real");
  (peek ? punctura_insertion_peek : punctura_insertion_step)(insertion, mxGetPr(p), mxGetPr(a), mxGetPr(force));
  return force;
}

static mxArray* save(punctura_insertion* insertion) {
  const size_t size = punctura_insertion_state_size(insertion);
  mxArray* state = mxCreateNumericMatrix(1, size, mxUINT8_CLASS, mxREAL);
  check(punctura_insertion_save(insertion, mxGetData(state), size));
  return state;
}

void mexFunction(int nlhs, mxArray* plhs[], int nrhs, const mxArray* prhs[]) {
  char command[16] = "";
  punctura_insertion* insertion;
  (void)nlhs;
  require(nrhs >= 2 && mxIsChar(prhs[0]), "call PuncturaInsertion instead");
  require(punctura_check_abi(), "punctura.h and libpunctura do not fit together: compile punctura_mex.c again");
  mxGetString(prhs[0], command, sizeof command);
  mexAtExit(free_all);
  if (strcmp(command, "new") == 0) {
    plhs[0] = new_insertion(prhs[1]);
    return;
  }
  if (strcmp(command, "free") == 0) {
    free_one(mxGetScalar(prhs[1]));
    return;
  }
  insertion = insertions[slot_of(prhs[1])];
  if (strcmp(command, "reset") == 0) {
    check(punctura_insertion_reset(insertion));
  } else if (strcmp(command, "commit") == 0) {
    check(punctura_insertion_commit(insertion));
  } else if (strcmp(command, "step") == 0 && nrhs == 4) {
    plhs[0] = one(insertion, prhs[2], prhs[3], 0);
  } else if (strcmp(command, "peek") == 0 && nrhs == 4) {
    plhs[0] = one(insertion, prhs[2], prhs[3], 1);
  } else if (strcmp(command, "run") == 0 && nrhs == 4) {
    plhs[0] = run(insertion, prhs[2], prhs[3]);
  } else if (strcmp(command, "save") == 0) {
    plhs[0] = save(insertion);
  } else if (strcmp(command, "restore") == 0 && nrhs == 3) {
    require(mxIsUint8(prhs[2]), "the state must be uint8");
    check(punctura_insertion_restore(insertion, mxGetData(prhs[2]), mxGetNumberOfElements(prhs[2])));
  } else {
    require(0, "unknown command, or a wrong number of arguments");
  }
}
