/* tests/program/test_fvi_plot.c -- The program build/fvi: a picture of the table.
 * Run alone: make test-fvi_plot */
#define _GNU_SOURCE
#include "program.h"

/* Without gnuplot the refusal is all that can be seen. */
static int is_drawn(void)
{
    return shell("command -v gnuplot > /dev/null") == 0;
}

/* How often the word stands in a file. */
static size_t count_words(const char *file, const char *word)
{
    char line[200];
    snprintf(line, sizeof line, "grep -o '%s' %s | wc -l", word, file);
    ck_assert_int_eq(shell(line), 0);
    return strtoul(out, NULL, 10);
}

/* The table is what it is without the picture; panels are x, energy, phase, a line for each
 * mass. */
START_TEST(a_picture_is_drawn_beside_the_table)
{
    if (!is_drawn())
        return;
    ck_assert_int_eq(fvi("run --alpha 0.3"), 0);
    char *want = strdup(out);
    ck_assert_int_eq(fvi("run --alpha 0.3 --plot one.svg"), 0);
    ck_assert_str_eq(out, want);
    ck_assert_str_eq(err, "");
    free(want);
    ck_assert_uint_eq(count_words("one.svg", "id=.gnuplot_plot_"), 3);
    ck_assert_uint_eq(count_words("one.svg", ">energy<"), 1);
    ck_assert_int_eq(
        fvi("run --potential chain:3,1,1 --plot three.SVG --format "
            "json --columns y,t,p,energy -o t"),
        0);
    ck_assert_str_eq(out, "");
    ck_assert_uint_eq(count_words("three.SVG", "id=.gnuplot_plot_"), 7);
    ck_assert_int_eq(fvi("run --error 1e-4 --plot \"it's.svg\" --columns x"),
                     0);
    ck_assert_uint_eq(count_words("it\\'s.svg", "id=.gnuplot_plot_"), 1);
    ck_assert_int_eq(fvi("exact --plot e.png --columns x,p"), 0);
    ck_assert_int_eq(shell("head -c 4 e.png | tail -c 3"), 0);
    ck_assert_str_eq(out, "PNG");
    ck_assert_int_eq(shell("ls -A | grep '[.]new\\|[.]fvi-'"), 1);
}
END_TEST

/* gnuplot would take what stands behind a | for a command: it sees no name. */
START_TEST(a_name_is_no_command)
{
    if (!is_drawn())
        return;
    ck_assert_int_eq(fvi("run --steps 3 --plot '|id>owned;#.svg'"), 0);
    ck_assert_int_eq(fvi("exact --steps 3 --plot '| id >owned; #.png'"), 0);
    ck_assert_int_eq(fvi("run --steps 3 --plot '`id>owned`.svg'"), 0);
    ck_assert(!exists("owned"));
    ck_assert(exists("|id>owned;#.svg") && exists("`id>owned`.svg"));
    ck_assert_int_eq(shell("rm '|id>owned;#.svg' '| id >owned; #.png' "
                           "'`id>owned`.svg'"),
                     0);
}
END_TEST

/* A file of the user's beside it is not touched, whatever its name; the picture keeps its
 * permissions, and a link stays one. */
START_TEST(what_stands_beside_a_picture_is_not_touched)
{
    if (!is_drawn())
        return;
    ck_assert_int_eq(shell("echo mine > n.svg.new; : > n.svg; chmod 640 n.svg; "
                           "ln -s n.svg l.svg; mkfifo l.svg.new; \"$FVI\" run "
                           "--steps 3 --plot l.svg > /dev/null && "
                           "cat n.svg.new && test -L l.svg -a -s n.svg -a -p "
                           "l.svg.new && ls -l n.svg"),
                     0);
    ck_assert(strncmp(out, "mine\n-rw-r-----", 15) == 0);
    ck_assert_int_eq(shell("rm n.svg* l.svg*"), 0);
}
END_TEST

/* A long table is thinned: its picture is not longer than that of 5000 rows twice. */
START_TEST(a_picture_of_a_long_table_is_short)
{
    if (!is_drawn())
        return;
    ck_assert_int_eq(fvi("run --steps 99999 --columns x --plot long.svg "
                         "> /dev/null"),
                     0);
    ck_assert_int_eq(shell("wc -c < long.svg"), 0);
    const unsigned long bytes = strtoul(out, NULL, 10);
    ck_assert(bytes > 1000 && bytes < 2 * 5000 * 16);
}
END_TEST

/* Complete, or as it was. */
START_TEST(no_picture_without_a_whole_run)
{
    ck_assert_int_eq(shell("echo old > p.svg; \"$FVI\" run --alpha 1 --rho "
                           "1e30 --plot p.svg; test $? = 1; cat p.svg"),
                     0);
    ck_assert_str_eq(strrchr(out, 'o'), "old\n");
    ck_assert_int_eq(
        shell("mkfifo pipe.svg; \"$FVI\" run --plot pipe.svg > /dev/null; "
              "test $? = 2 && test -p pipe.svg"),
        0);
    ck_assert_int_eq(shell("\"$FVI\" run --plot missing/p.svg > /dev/null; "
                           "test $? = 1"),
                     0);
    /* The script has room, the picture has not. */
    ck_assert_int_eq(shell("echo old > f.svg; (ulimit -f 8; \"$FVI\" run "
                           "--steps 9 --plot f.svg > /dev/null; echo $?); "
                           "cat f.svg"),
                     0);
    ck_assert_str_eq(out, "1\nold\n");
    ck_assert_int_eq(shell("ls -A | grep '[.]fvi-'"), 1);
    /* where gnuplot is not: nothing is begun */
    ck_assert_int_eq(shell("mkdir -p empty; PATH=$PWD/empty \"$FVI\" run "
                           "--plot none.svg; test $? = 1"),
                     0);
    ck_assert_str_eq(out, "");
    ck_assert_str_eq(err, "fvi: --plot: gnuplot is not installed\n");
    ck_assert(!exists("none.svg"));
}
END_TEST

START_TEST(other_pictures_are_refused)
{
    static const char *const lines[] = { "run --plot p.pdf",
                                         "run --plot svg",
                                         "run --plot ''",
                                         "run --plot .svg",
                                         "run --plot p.svg --columns t",
                                         "run --plot \"$(printf 'a\\nb.svg')\"",
                                         "sweep --vary x0=1:2:2 --plot p.svg",
                                         "coefficients --plot p.svg" };
    for (size_t n = 0; n < LEN(lines); n++) {
        ck_assert_msg(fvi(lines[n]) == 2, "%s", lines[n]);
        ck_assert_str_eq(out, "");
        ck_assert_uint_eq(count_lines(err), 2);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: a picture");
    ADD_CASE(suite, "values", a_picture_is_drawn_beside_the_table,
             a_picture_of_a_long_table_is_short, a_name_is_no_command,
             what_stands_beside_a_picture_is_not_touched);
    ADD_CASE(suite, "errors", no_picture_without_a_whole_run,
             other_pictures_are_refused);
    return run_suite_of_program(suite);
}
