/* src/system/fail.c -- Write the text of an error. */
#include <fvi/error.h>

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Write a text that is too long for the error, with "..." in place of its middle. The texts that a user typed may be
 * long, and the reason for the refusal stands at the end. */
static void shorten_text(char *text, size_t length, const char *format,
                         va_list arguments)
{
    const size_t end = FVI_ERROR_ROOM / 2; /* bytes of the end of the text, including its '\0' */
    char *whole = malloc(length + 1);
    if (whole) {
        vsnprintf(whole, length + 1, format, arguments);
        memcpy(text + FVI_ERROR_ROOM - end - 3, "...", 3);
        memcpy(text + FVI_ERROR_ROOM - end, whole + length + 1 - end, end);
    }
    free(whole);
}

int fvi_fail(fvi_error *error, int code, const char *field, double value,
             const char *format, ...)
{
    if (!error)
        return code;
    error->code = code;
    error->field = field;
    error->value = value;
    error->index = 0;
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length =
        vsnprintf(error->text, sizeof error->text, format, arguments);
    if (length > 0 && (size_t)length >= sizeof error->text)
        shorten_text(error->text, (size_t)length, format, again);
    va_end(again);
    va_end(arguments);
    for (char *t = error->text; *t; t++) /* replace control characters, so that the text stays one line */
        if ((unsigned char)*t < ' ')
            *t = '?';
    return code;
}
