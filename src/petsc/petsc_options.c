/* src/petsc/petsc_options.c -- Read the options of build/fvi_petsc.         [H 28] */
#include "petsc_options.h"

#include <stdio.h>
#include <string.h>

static PetscErrorCode read_words(petsc_options *w)
{
    PetscFunctionBeginUser;
    PetscCall(PetscOptionsGetString(NULL, NULL, "-system", w->folder,
                                    sizeof w->folder, &w->has_folder));
    if (w->has_folder)
        w->x0 = 0; /* at rest, as `fvi run --system` */
    w->lengths = 3;
    PetscCall(PetscOptionsGetIntArray(NULL, NULL, "-grid", w->n, &w->lengths,
                                      &w->has_grid));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-damping", &w->damping,
                                  &w->has_damping));
    PetscCall(PetscOptionsGetString(NULL, NULL, "-o", w->file, sizeof w->file,
                                    &w->writes));
    PetscCall(PetscOptionsGetString(NULL, NULL, "-checkpoint", w->checkpoint,
                                    sizeof w->checkpoint, &w->saves));
    PetscCall(PetscOptionsGetBool(NULL, NULL, "-resume", &w->resumes, NULL));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-alpha", &w->alpha, &w->has_alpha));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-h", &w->h, NULL));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-x0", &w->x0, NULL));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-p0", &w->p0, NULL));
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-steps", &w->steps, NULL));
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-stop", &w->stop, &w->stops));
    PetscFunctionReturn(0);
}

/* ---- several dampers ---- */

/* Refuse an option that is given twice, because PETSc would keep the last one without a message. */
static PetscErrorCode refuse_twice(const char *name)
{
    int count, times = 0;
    char **words;
    PetscFunctionBeginUser;
    PetscCall(PetscGetArgs(&count, &words));
    for (int i = 1; i < count; i++)
        times += strcmp(words[i], name) == 0;
    PetscCheck(times <= 1, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "%s is given twice: number several dampers -damper_1, -damper_2, ...", name);
    PetscFunctionReturn(0);
}

/* Refuse dampers whose numbers have a gap: options that begin with `damper` and that nobody has read. The next number
 * is `count` + 1. */
static PetscErrorCode refuse_left(PetscInt count)
{
    PetscInt left;
    char **names, **values;
    PetscFunctionBeginUser;
    PetscCall(PetscOptionsLeftGet(NULL, &left, &names, &values));
    for (PetscInt i = 0; i < left; i++)
        PetscCheck(strncmp(names[i], "damper", 6) != 0, PETSC_COMM_WORLD, PETSC_ERR_USER,
                   "-%s: dampers are numbered without a gap, and the next is -damper_%d",
                   names[i], (int)count + 1);
    PetscCall(PetscOptionsLeftRestore(NULL, &left, &names, &values));
    PetscFunctionReturn(0);
}

static PetscErrorCode read_dampers(petsc_options *w)
{
    PetscBool is_there = PETSC_TRUE;
    PetscFunctionBeginUser;
    while (is_there) {
        const char *text;
        char name[24];
        snprintf(name, sizeof name, "-damper_%d", (int)w->dampers + 1);
        PetscCall(PetscOptionsFindPair(NULL, NULL, name, &text, &is_there));
        if (!is_there)
            break;
        PetscCheck(text && *text, PETSC_COMM_WORLD, PETSC_ERR_USER,
                   "%s wants 'G : LAW [: PAST]'", name);
        PetscCall(refuse_twice(name));
        PetscCall(PetscRealloc((size_t)(w->dampers + 1) * sizeof *w->damper, &w->damper));
        w->damper[w->dampers++] = text;
    }
    PetscCall(refuse_left(w->dampers));
    PetscCheck(w->dampers == 0 || !w->has_alpha, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "-alpha is not read with -damper_1: each damper has its own law");
    PetscCheck(w->dampers == 0 || !w->has_damping, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "-damping is not read with -damper_1: each damper has its own matrix");
    PetscFunctionReturn(0);
}

PetscErrorCode petsc_free_options(petsc_options *w)
{
    PetscFunctionBeginUser;
    PetscCall(PetscFree(w->damper));
    PetscFunctionReturn(0);
}

/* ---- all of them ---- */

PetscErrorCode petsc_read_options(petsc_options *w)
{
    PetscFunctionBeginUser;
    *w = (petsc_options){ .alpha = 0.5,
                   .h = 0.1,
                   .x0 = 1,
                   .steps = 200,
                   .damping = 0.01,
                   .n = { 1, 1, 1 } };
    PetscCall(read_words(w));
    PetscCall(read_dampers(w));
    PetscCheck(w->has_folder != w->has_grid, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "one of -system DIR and -grid N,N is wanted");
    PetscCheck(!w->has_grid
                   || (w->lengths >= 1 && w->n[0] >= 1 && w->n[1] >= 1
                       && w->n[2] >= 1),
               PETSC_COMM_WORLD, PETSC_ERR_USER, "-grid has a length below 1");
    PetscCheck(w->damping >= 0, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "-damping is negative");
    PetscCheck(w->has_grid || !w->has_damping, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "-damping is that of a grid; a folder has C.mtx");
    PetscCheck(w->steps >= 1, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "-steps is less than 1");
    PetscCheck(w->saves || (!w->stops && !w->resumes), PETSC_COMM_WORLD,
               PETSC_ERR_USER, "-stop and -resume want -checkpoint FILE");
    w->stop = w->stops ? w->stop : w->steps;
    PetscCheck(w->stop >= 1 && w->stop <= w->steps, PETSC_COMM_WORLD,
               PETSC_ERR_USER, "-stop is not from 1 to the number of steps");
    PetscFunctionReturn(0);
}
