/* tests/workshop/exit.c -- In the place of exit and the like in a student's file: to a
 * test, a process that ends with 0 is one that has passed. */
#include <check.h>

#define ENDS(name)                                                             \
    void student_##name(int code);                                             \
    void student_##name(int code)                                              \
    {                                                                          \
        ck_abort_msg("your file calls " #name "(%d) where the test goes on",   \
                     code);                                                    \
    }

ENDS(exit)
ENDS(_exit)
ENDS(_Exit)
ENDS(quick_exit)
