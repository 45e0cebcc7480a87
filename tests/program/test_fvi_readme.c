/* tests/program/test_fvi_readme.c -- The commands of README.md and of the manual, pasted into a bare shell.
 * Run alone: make test-fvi_readme */
#define _GNU_SOURCE
#include "program.h"

/* Where commands stand: the page, the section, how many, and how many show their output. */
static const struct {
    const char *path, *section;
    size_t commands, outputs;
    const char *plots; /* the picture that they draw */
} parts[9] = {
    { "README.md", "\n## Use\n", 1, 1, NULL },
    { "chapters/handbook/manual.md", "\n## The program\n", 14, 12, "build/own.svg" },
    { "chapters/handbook/manual.md", "\n## Any Lagrangian\n", 6, 6, "build/elastic.svg" },
    { "chapters/handbook/manual.md", "\n## A building on isolators\n", 1, 1, NULL },
    { "chapters/handbook/reports.md", "\n## A frame on a springpot\n", 1, 1, NULL },
    { "chapters/handbook/reports.md", "\n## Loops, peaks and comparisons\n", 3, 2,
      "build/loop.svg" },
    { "chapters/handbook/reports.md", "\n## A response spectrum, a section, a diagram\n",
      2, 1, NULL },
    { "chapters/handbook/reports.md", "\n## A measured ground\n", 1, 1, NULL },
    { "chapters/handbook/reports.md", "\n## The whole report\n", 1, 1,
      "build/hysteresis.svg" },
};
static char pages[9][1 << 16];

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
    static const char gaps[] = " \t\n,";
    for (;;) {
        got += strspn(got, gaps);
        want += strspn(want, gaps);
        if (!*got || !*want)
            return !*got && !*want;
        const size_t m = strcspn(got, gaps), n = strcspn(want, gaps);
        char *ends[2];
        const double a = strtod(got, &ends[0]), b = strtod(want, &ends[1]);
        const int numbers = ends[0] == got + m && ends[1] == want + n;
        if (numbers ? !(fabs(a - b) <= 1e-6 * fabs(b)) /* NaN is no number */
                    : m != n || strncmp(got, want, n) != 0)
            return 0;
        got += m;
        want += n;
    }
}

/* Each ```sh block runs; where a ```text block stands right behind it, it is what comes
 * out, on both streams. */
static void run_and_compare(int part)
{
    size_t commands = 0, outputs = 0;
    ck_assert_int_eq(shell("mkdir -p build; ln -sf \"$FVI\" build/fvi"), 0);
    const int plots = shell("command -v gnuplot > /dev/null") == 0;
    char *at = strstr(pages[part], parts[part].section), *end, *command;
    ck_assert_ptr_nonnull(at);
    for (at++; (command = block(at, "```sh\n", &end)); at = end + 3) {
        char line[4000], *want_end;
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
    ck_assert_uint_eq(commands, parts[part].commands);
    ck_assert_uint_eq(outputs, parts[part].outputs);
    ck_assert(!plots || !parts[part].plots || exists(parts[part].plots));
}

START_TEST(the_commands_of_the_readme_are_as_they_are_printed)
{
    run_and_compare(0);
}
END_TEST

START_TEST(the_tour_of_the_manual_is_as_it_is_printed)
{
    run_and_compare(1);
}
END_TEST

/* The problems of H 29, a command each. */
START_TEST(every_lagrangian_of_the_manual_runs)
{
    run_and_compare(2);
}
END_TEST

/* The whole report of an engineer. */
START_TEST(the_report_of_a_building_is_as_it_is_printed)
{
    run_and_compare(3);
}
END_TEST

/* The files of a section are those of the section before. */
START_TEST(reports_come_out_as_they_are_printed)
{
    for (int part = 4; part < (int)LEN(parts); part++)
        run_and_compare(part);
}
END_TEST

int main(void)
{
    for (size_t part = 0; part < LEN(parts); part++)
        read_file(parts[part].path, pages[part], sizeof pages[part]);
    Suite *suite = suite_create("the program fvi: README.md, the manual");
    ADD_CASE(suite, "values", the_commands_of_the_readme_are_as_they_are_printed,
             the_tour_of_the_manual_is_as_it_is_printed,
             every_lagrangian_of_the_manual_runs,
             the_report_of_a_building_is_as_it_is_printed,

             reports_come_out_as_they_are_printed);
    return run_suite_of_program(suite);
}
