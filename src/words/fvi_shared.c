/* src/words/fvi_shared.c -- A potential from a shared object. */
#define _GNU_SOURCE
#include "fvi_shared.h"

#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

int fvi_shared_name(const char *text)
{
    const size_t length = strlen(text);
    return length > 3 && strcmp(text + length - 3, ".so") == 0;
}

/* A name without a folder is that of a file here, not of one where the system keeps its
 * libraries. */
int fvi_shared_open(const char *text, void **library, fvi_potential *U,
                    fvi_complaint c)
{
    char path[PATH_MAX];
    const int length = snprintf(path, sizeof path, "%s%s",
                                strchr(text, '/') ? "" : "./", text);
    *library = length < (int)sizeof path ? dlopen(path, RTLD_NOW) : NULL;
    if (!*library)
        return fvi_refuse(c, "--potential: cannot load '%s': %s", text,
                          length < (int)sizeof path ? dlerror()
                                                    : "the name is too long");
    const fvi_potential *found = dlsym(*library, "fvi_user_potential");
    if (found && found->value && found->gradient && found->hessian) {
        *U = *found;
        return 0;
    }
    fvi_shared_close(*library);
    *library = NULL;
    return fvi_refuse(c,
                      found ? "--potential: '%s': a function is missing in "
                              "fvi_user_potential"
                            : "--potential: '%s' defines no fvi_user_potential",
                      text);
}

void fvi_shared_close(void *library)
{
    if (library)
        dlclose(library);
}
