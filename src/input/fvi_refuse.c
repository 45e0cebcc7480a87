/* src/input/fvi_refuse.c -- Describe in one line what is wrong with the command line. */
#include "fvi_refuse.h"

#include <stdio.h>
#include <string.h>

int fvi_refuse_option(fvi_error *error, const char *given,
                      const char *const *names)
{
    const char *word = given + strspn(given, "-"),
               *nearest = fvi_nearest_word(word, strcspn(word, "="), names);
    return fvi_refuse(error, NULL, "%s: no such option%s%s%s", given, nearest ? "; did you mean --" : "",
                      nearest ? nearest : "", nearest ? "?" : "");
}

/* Return the hyphens of an option: none for DATA of a fit, which is no option, one for -o, else two. */
static const char *hyphens_of(const char *field)
{
    return strncmp(field, "DATA", 4) == 0 ? "" : strcmp(field, "o") == 0 ? "-" : "--";
}

int fvi_complaint(const fvi_error *error, char text[FVI_COMPLAINT])
{
    enum { AHEAD = 5 /* letters of "fvi: " */ };
    const char *caret = strchr(error->text, '\n');
    const int first = caret ? (int)(caret - error->text) : FVI_ERROR_ROOM;
    int front = 0;
    if (error->field)
        front = snprintf(text, FVI_COMPLAINT, "%s%s: ", hyphens_of(error->field),
                         error->field);
    const size_t room = FVI_COMPLAINT - (size_t)front;
    if (caret)
        snprintf(text + front, room, "%.*s\n%*s%s", first, error->text,
                 front + AHEAD, "", caret + 1);
    else
        snprintf(text + front, room, "%s", error->text);
    return error->code == FVI_ENOMEM ? 1 : 2;
}
