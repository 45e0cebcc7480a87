/* src/input/fvi_shared.c -- Load a potential from a shared object or from a C file. */
#define _GNU_SOURCE
#include "fvi_shared.h"
#include "fvi_compile.h"
#include "fvi_files.h"

#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

static int ends_with(const char *text, const char *end)
{
    const size_t length = strlen(text), last = strlen(end);
    return length > last && strcmp(text + length - last, end) == 0;
}

int fvi_shared_name(const char *text)
{
    return ends_with(text, ".so") || ends_with(text, ".c");
}

/* The first C file that was compiled. It stays loaded, because a sweep opens the same file before each of its runs. */
static char *compiled;
static void *kept;

static const char *(*words_of_user)(int code);

const char *fvi_shared_error(int code)
{
    return words_of_user ? words_of_user(code) : NULL;
}

static int compile(const char *text, const char *path, void **library,
                   fvi_error *c)
{
    char why[200] = "";
    *library = compiled && strcmp(compiled, text) == 0 ? kept : NULL;
    if (*library)
        return 0;
    if (fvi_compile(path, library, sizeof why, why))
        return fvi_refuse(c, "potential", "cannot compile '%s': %s", text, why);
    if (!compiled && (compiled = strdup(text)))
        kept = *library;
    return 0;
}

/* A name without a folder means a file in the current folder, so "./" is put in front of it. Otherwise dlopen would
 * search the folders of the system, and the compiler would take -d/a.c for an option. */
int fvi_shared_open(const char *text, void **library, fvi_potential *U,
                    fvi_error *c)
{
    char path[PATH_MAX];
    const int length =
        snprintf(path, sizeof path, "%s%s", *text == '/' ? "" : "./", text);
    *library = NULL;
    if (length >= (int)sizeof path)
        return fvi_refuse(c, "potential", "'%s': the name is too long", text);
    fvi_mark_read("potential", path);
    if (ends_with(text, ".c")) {
        int status = compile(text, path, library, c);
        if (status)
            return status;
    } else if (!(*library = dlopen(path, RTLD_NOW))) {
        return fvi_refuse(c, "potential", "cannot load '%s': %s", text, dlerror());
    }
    const fvi_potential *found = dlsym(*library, "fvi_user_potential");
    if (found && found->value && found->gradient && found->hessian) {
        *(void **)&words_of_user = dlsym(*library, "fvi_user_error");
        *U = *found;
        return 0;
    }
    fvi_shared_close(*library);
    *library = NULL;
    return fvi_refuse(c, "potential",
                      found ? "'%s': a function is missing in "
                              "fvi_user_potential"
                            : "'%s' defines no fvi_user_potential",
                      text);
}

void fvi_shared_close(void *library)
{
    if (!library || library == kept)
        return;
    words_of_user = NULL; /* the function is in the library */
    dlclose(library);
}
