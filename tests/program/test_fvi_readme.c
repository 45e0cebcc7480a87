/* tests/program/test_fvi_readme.c -- The commands of README.md, pasted into a bare shell.
 * Run alone: make test-fvi_readme */
#define _GNU_SOURCE
#include "program.h"

static char page[1 << 16];

/* The next block of this kind behind `at`, without its fences, and where it ends; NULL if
 * there is none before the next heading. */
static char *block(char *at, const char *fence, char **end)
{
    char *heading = strstr(at, "\n## "), *from = strstr(at, fence);
    if (!from || (heading && heading < from))
        return NULL;
    from += strlen(fence);
    *end = strstr(from, "```");
    ck_assert_ptr_nonnull(*end);
    return from;
}

/* The same words, and numbers that agree to six digits: the last ones of a fit depend on
 * the C library. */
static int agree(const char *got, const char *want)
{
    static const char parts[] = " \t\n,";
    for (;;) {
        got += strspn(got, parts);
        want += strspn(want, parts);
        if (!*got || !*want)
            return !*got && !*want;
        const size_t m = strcspn(got, parts), n = strcspn(want, parts);
        char *ends[2];
        const double a = strtod(got, &ends[0]), b = strtod(want, &ends[1]);
        const int numbers = ends[0] == got + m && ends[1] == want + n;
        if (numbers ? fabs(a - b) > 1e-6 * fabs(b)
                    : m != n || strncmp(got, want, n) != 0)
            return 0;
        got += m;
        want += n;
    }
}

/* Each ```sh block runs; where a ```text block stands right behind it, it is what comes
 * out, on both streams. */
START_TEST(the_tour_is_as_it_is_printed)
{
    size_t commands = 0, outputs = 0;
    ck_assert_int_eq(shell("mkdir -p build; ln -sf \"$FVI\" build/fvi"), 0);
    const int plots = shell("command -v gnuplot > /dev/null") == 0;
    char *at = strstr(page, "\n## The program\n"), *end, *command;
    ck_assert_ptr_nonnull(at);
    for (at++; (command = block(at, "```sh\n", &end)); at = end + 3) {
        char line[1000], *want_end;
        *end = '\0';
        char *plot = strstr(command, " --plot ");
        if (plot && !plots)
            *plot = '\0';
        snprintf(line, sizeof line, "{ %s\n} 2>&1", command);
        ck_assert_msg(shell(line) == 0, "%s: %s", command, out);
        commands++;
        if (strncmp(end + 3, "\n\n```text\n", 10) != 0)
            continue;
        char *want = block(end + 3, "```text\n", &want_end);
        *want_end = '\0';
        ck_assert_msg(agree(out, want), "%s printed\n%s, not\n%s", command, out,
                      want);
        end = want_end;
        outputs++;
    }
    ck_assert(commands == 5 && outputs == 4);
    ck_assert(!plots || exists("build/own.svg"));
}
END_TEST

int main(void)
{
    read_file("README.md", page, sizeof page);
    Suite *suite = suite_create("the program fvi: README.md");
    ADD_CASE(suite, "values", the_tour_is_as_it_is_printed);
    return run_suite_of_program(suite);
}
