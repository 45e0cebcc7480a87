/* tests/program/test_fvi_fit_records.c -- The command `fvi fit`: several masses and columns, several
 * records, folders of matrices, wrong readings.
 * Run alone: make test-fvi_fit_records */
#define _GNU_SOURCE
#include "fit_rows.h"
#include "fit_tables.h"
#include "folder.h"

static double estimate_of(const char *name)
{
    double row[4];
    row_of(name, row);
    ck_assert(row[2] <= row[0] && row[0] <= row[3]);
    return row[0];
}

#define CHAIN "--potential chain:2,4,0 --damper 'd=x2-x1 : zener:1.2,0.3,0.8' "
#define GUESS "--potential chain:2,3,0 --damper 'd=x2-x1 : zener:1,0.4,1' "

/* Exact rows of `fvi exact`, which takes no steps, give back what was put in. */
START_TEST(fit_compares_columns_of_several_masses)
{
    ck_assert_int_eq(fvi("exact " CHAIN "--x0 1,0 --p0 0 --h 0.1 --steps 100 --columns t,x2,v1,x1 "
                         "-o two.tsv"),
                     0);
    ck_assert_int_eq(fvi("fit " GUESS "--x0 1,0 --p0 0 --starts 3 --fit c,d.rho,d.alpha,d.time "
                         "--compare 'x1,x2,v1' two.tsv --curve c.tsv"),
                     0);
    ck_assert_double_eq_tol(estimate_of("c"), 4, 1e-6);
    ck_assert_double_eq_tol(estimate_of("d.rho"), 1.2, 1e-5);
    ck_assert_double_eq_tol(estimate_of("d.alpha"), 0.3, 1e-6);
    ck_assert_double_eq_tol(estimate_of("d.time"), 0.8, 1e-5);
    ck_assert(strstr(out, "# compare = x1,x2,v1\n") && strstr(out, "# estimated sigma of v1 = "));
    ck_assert_double_eq(value_of("points"), 303);
    static char text[1 << 16];
    char path[PATH_MAX + 100];
    snprintf(path, sizeof path, "%s/c.tsv", folder);
    read_file(path, text, sizeof text);
    ck_assert(strncmp(text, "# t\tx1\tx1_fit\tx1_residual\tx2\t", 29) == 0);
    ck_assert_int_eq(fvi("fit " GUESS "--x0 1,0 --p0 0 two.tsv"), 2);
    ck_assert(strstr(err, "has 2 masses: --compare says"));
}
END_TEST

/* Of two springpots in series each number is fitted by the name that was typed, whichever order is larger. */
START_TEST(fit_keeps_the_names_of_a_pair)
{
    static const char *const fits[][2] = {
        { "--damper 'd=x : maxwell2:0.5,0.2,0.7,0.4' --fit d.rho1", "d.rho1" },
        { "--damper 'd=x : maxwell2:0.7,0.4,0.5,0.2' --fit d.rho2", "d.rho2" },
        { "--damping maxwell2:0.4,0.2,0.8,0.4 --fit d1.rho2", "d1.rho2" },
        { "--damper 'e=x : spring:0' --damper 'd=x : maxwell2:0.4,0.2,0.5,0.4' --fit d.rho2", "d.rho2" },
    };
    static const double want[] = { 0.4, 0.4, 0.7, 0.7 };
    char line[300];
    ck_assert_int_eq(fvi("run --damper 'd=x : maxwell2:0.4,0.2,0.7,0.4' --method fvi-lobatto4 --p0 0 --h 0.1 "
                         "--steps 100 --columns t,x -o one.tsv"),
                     0);
    for (size_t i = 0; i < LEN(fits); i++) {
        snprintf(line, sizeof line, "fit --p0 0 --starts 3 %s one.tsv", fits[i][0]);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        ck_assert_near(estimate_of(fits[i][1]), want[i], 1e-5, "%s", fits[i][1]);
    }
}
END_TEST

/* Two tests of one body, the second with its own start and its own force, which its file has up to its
 * own last time. */
START_TEST(fit_takes_several_records)
{
    write_file("push.tsv", "0 0\n3 1\n6 0\n");
    ck_assert_int_eq(fvi("run --alpha 0.3 --rho 0.4 --p0 0 --method fvi-lobatto6 --h 0.1 --steps 100 "
                         "--columns t,x -o one.tsv"),
                     0);
    ck_assert_int_eq(fvi("run --alpha 0.3 --rho 0.4 --x0 0 --p0 0.2 --force file:push.tsv --method "
                         "fvi-lobatto6 --h 0.1 --steps 60 --columns t,x -o two.tsv"),
                     0);
    ck_assert_int_eq(fvi("fit --p0 0 --fit alpha,rho,c --starts 4 one.tsv "
                         "'two.tsv : x0=0 : p0=0.2 : force=file:push.tsv' --curve c.tsv"),
                     0);
    ck_assert_double_eq_tol(estimate_of("alpha"), 0.3, 1e-6);
    ck_assert_double_eq_tol(estimate_of("rho"), 0.4, 1e-6);
    ck_assert_double_eq_tol(estimate_of("c"), 1, 1e-6);
    ck_assert_double_eq(value_of("points"), 162);
    ck_assert(strstr(out, "# data = one.tsv\n# data = two.tsv : x0=0 : p0=0.2"));
    /* a force of all records, as long as the longest of them */
    ck_assert_int_eq(fvi("fit --x0 0 --p0 0.2 --force file:push.tsv --fit alpha,rho,c --starts 4 two.tsv"),
                     0);
    ck_assert_double_eq_tol(estimate_of("alpha"), 0.3, 1e-6);
    ck_assert_int_eq(fvi("fit --p0 0 --force file:push.tsv --fit alpha one.tsv"), 2);
    ck_assert(strstr(err, "ends at t = 6, the run at 10"));
}
END_TEST

/* A folder of matrices, with the law of its C.mtx or with several dampers. */
START_TEST(fit_takes_a_folder)
{
    write_chain();
    ck_assert_int_eq(fvi("exact --system chain --alpha 0.3 --x0 1,0,0 --h 0.1 --steps 100 "
                         "--columns t,x1,x3 -o c.tsv"),
                     0);
    ck_assert_int_eq(fvi("fit --system chain --alpha 0.4 --x0 1,0,0 --compare x1,x3 --sigma 0.001 "
                         "--fit alpha,x0_2 --starts 2 c.tsv"),
                     1); /* no noise: chi2 is too small to be believed */
    ck_assert_double_eq_tol(estimate_of("alpha"), 0.3, 1e-4);
    ck_assert_double_eq_tol(estimate_of("x0_2"), 0, 1e-4);
    ck_assert(strstr(out, "# method = fvi-lobatto4d\n"));
    ck_assert_int_eq(fvi("fit --system chain --damper 'C.mtx : power:0.7,0.4' --x0 1,0,0 --compare "
                         "x1,x3 --sigma 0.001 --fit d1.rho,d1.alpha --starts 2 c.tsv"),
                     1);
    ck_assert_double_eq_tol(estimate_of("d1.rho"), 1, 1e-3);
    ck_assert_double_eq_tol(estimate_of("d1.alpha"), 0.3, 1e-3);
    ck_assert_int_eq(fvi("fit --system chain --x0 1,0,0 --compare x1,x3 --fit mass c.tsv"), 2);
    ck_assert(strstr(err, "'mass'"));
}
END_TEST

/* One reading in twenty is nonsense. */
START_TEST(fit_forgives_wrong_readings)
{
    FILE *f = file_in_folder("wild.tsv");
    for (size_t i = 0; i < REF_POINTS; i++)
        fprintf(f, "%.1f\t%.5f\n", 0.1 * (double)(i + 1),
                ref_low[i] + 0.001 * sin(99. * (double)i) + (i % 20 == 7 ? 1 : 0));
    fclose(f);
    ck_assert_int_eq(fvi("fit --p0 0.25 --fit alpha,rho,c --starts 4 --huber 1.345 wild.tsv"), 0);
    ck_assert_double_eq_tol(estimate_of("alpha"), 0.3, 1e-3);
    ck_assert(strstr(out, "# huber = 1.345\n") && strstr(out, "# intervals = by the profile of Huber's"));
    ck_assert(value_of("estimated sigma") < 0.002);
}
END_TEST

/* A body that swings fast and is seen seldom is stiff: the steps are its own, without a word. */
START_TEST(fit_of_a_stiff_body_takes_steps_of_its_own)
{
    ck_assert_int_eq(fvi("exact --mass 1e-7 --alpha 0.3 --rho 0.4 --x0 0 --p0 0 --force step:1,100 --h 0.1 "
                         "--steps 60 --columns t,x -o stiff.tsv"),
                     0);
    ck_assert_int_eq(fvi("fit --mass 1e-7 --x0 0 --p0 0 --force step:1,100 --fit alpha,rho,c --starts 3 "
                         "stiff.tsv"),
                     0);
    ck_assert(strstr(out, "# method = fvi-adaptive\n"));
    ck_assert_double_eq_tol(estimate_of("alpha"), 0.3, 1e-6);
    ck_assert_double_eq_tol(estimate_of("rho"), 0.4, 1e-6);
}
END_TEST

/* Nine columns without names are t and eight sensors. A ninth column read elsewhere, for example from t, would have large
 * residuals. */
START_TEST(fit_reads_eight_columns_without_names)
{
    static const char all[] = "x1,x2,x3,x4,x5,x6,x7,x8";
    char line[300];
    ck_assert_int_eq(fvi("run --dimension 8 --mass 1,2,3,4,5,6,7,8 --method fvi-lobatto4 --steps 40 --columns t,x "
                         "-o named.tsv"),
                     0);
    ck_assert_int_eq(shell("grep -v '^#' named.tsv > bare.tsv"), 0);
    snprintf(line, sizeof line, "fit --dimension 8 --mass 1,2,3,4,5,6,7,8 --h 0.1 --fit rho --starts 2 --compare %s bare.tsv",
             all);
    ck_assert_msg(fvi(line) == 0, "%s", err);
    ck_assert_double_lt(value_of("estimated sigma of x8"), 1e-8);
}
END_TEST

/* Data that the fitted run repeats to the last digit leave no noise to estimate: sigma is 0, and each interval is the
 * estimate alone. */
START_TEST(fit_of_rows_of_its_own_run_has_no_noise)
{
    ck_assert_int_eq(fvi("run --method fvi-lobatto4 --steps 40 --columns t,x -o own.tsv"), 0);
    ck_assert_msg(fvi("fit --h 0.1 own.tsv") == 0, "%s", err);
    ck_assert_ptr_nonnull(strstr(out, "\nalpha\t0.5\t0\t0.5\t0.5\nrho\t0.2\t0\t0.2\t0.2\n"));
    ck_assert_double_eq(value_of("estimated sigma"), 0);
    ck_assert_str_eq(err, "");
}
END_TEST

/* A header may have other names, and then the first columns are read. But a wanted name in another place says that the
 * first columns are others. */
START_TEST(a_name_in_another_place_is_not_passed_over)
{
    write_file("acc.csv", "time,acc,F\n0,1,5\n1,1,5\n");
    ck_assert_int_eq(fvi("run --force file:acc.csv --steps 2"), 2);
    ck_assert_ptr_nonnull(strstr(err, "fvi: --force: acc.csv: a line names a column 'F' and no 't', so the first columns "
                                      "are not what is wanted\n"));
    write_file("speed.csv", "time;v;x\n0;1;5\n1;1;5\n2;1;4\n");
    ck_assert_int_eq(fvi("fit speed.csv"), 2);
    ck_assert_ptr_nonnull(strstr(err, "fvi: DATA: speed.csv: a line names a column 'x' and no 't'"));
    write_file("turned.csv", "x,time\n5,0\n6,1\n7,2\n");
    ck_assert_int_eq(fvi("fit turned.csv"), 2);
    ck_assert_ptr_nonnull(strstr(err, "fvi: DATA: turned.csv: a line names a column 'x' and no 't'"));
    write_file("twice.csv", "omega,storage,storage\n1,2,3\n2,3,4\n4,5,6\n8,7,8\n");
    ck_assert_int_eq(fvi("fit --moduli twice.csv"), 2);
    ck_assert_ptr_nonnull(strstr(err, "a line names a column 'storage' and no 'loss'"));
    write_file("push.csv", "time,F\n0,5\n1,5\n"); /* F stands where it would be read */
    ck_assert_int_eq(fvi("run --force file:push.csv --steps 1 --columns F --format csv"), 0);
    ck_assert_str_eq(out, "F\n5\n5\n");
    ck_assert_int_eq(fvi("run --force file:acc.csv:time,F --steps 1 --columns F --format csv"), 0);
    ck_assert_str_eq(out, "F\n5\n5\n");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fits of records");
    ADD_CASE(suite, "records", fit_compares_columns_of_several_masses, fit_takes_several_records,
             fit_keeps_the_names_of_a_pair, fit_takes_a_folder, fit_forgives_wrong_readings,
             fit_of_a_stiff_body_takes_steps_of_its_own, fit_reads_eight_columns_without_names,
             fit_of_rows_of_its_own_run_has_no_noise, a_name_in_another_place_is_not_passed_over);
    return run_suite_of_program(suite);
}
