/* tests/program/test_fvi_columns.c -- Columns as expressions, and columns and reductions that are refused.
 * Run alone: make test-fvi_columns */
#define _GNU_SOURCE
#include "two_storeys.h"

/* A two-storey frame on a springpot, shaken by sin 8t. References: a prototype in Python, by the same
 * method, for drift and floor, to 16 digits; the damper's force there by an integral over
 * Hermite's polynomials, right to 1e-6. Its work is the energy that is missing. */
START_TEST(drifts_floors_and_forces_are_columns)
{
    static const double want[][4] = {
        { 2, -0.018297567077238498, 1.82975670772385, -0.8067952425966732 },
        { 5, 0.00856769077220398, -0.856769077220398, -0.2616397518516241 },
        { 10, -0.02503333860038799, 2.5033338600387993, -0.3339638379167262 }
    };
    ck_assert_int_eq(
        fvi_two("run", "--columns 't,drift=x2-x1,floor=a2+sin(8*t),"
                       "loop=d1.force1,work,balance,d1.work-work,d1.force2'"),
        0);
    ck_assert_ptr_nonnull(strstr(out, "\n# t\tdrift\tfloor\tloop\twork\tbalance\t"
                                      "d1.work-work\td1.force2\n"));
    for (size_t i = 0; i < LEN(want); i++) {
        const size_t k = (size_t)(50 * want[i][0]);
        ck_assert(cell(k, 0) == want[i][0]);
        ck_assert_near(cell(k, 1), want[i][1], 1e-14, "drift %zu", i);
        ck_assert_near(cell(k, 2), want[i][2], 1e-12, "floor %zu", i);
        ck_assert_near(cell(k, 3), want[i][3], 3e-6, "force %zu", i);
        ck_assert_near(cell(k, 5), 0, 1e-9, "balance %zu", i);
        ck_assert(cell(k, 4) > 0.1 && cell(k, 6) == 0 && cell(k, 7) == 0);
    }
}
END_TEST

/* An elastic pendulum with a strut, by four Lobatto nodes: the force of the damper at t = 4 and its
 * work, of a reference with 120 exponentials and Radau's method, right to 1e-8 and 1e-11; the
 * step 0.05 is off by about 1e-7 and 1e-9. */
START_TEST(a_damper_between_two_points_has_its_force)
{
    ck_assert_int_eq(
        fvi("run --lagrangian '(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2 - x2' "
            "--damper 'strut=sqrt(x1^2+x2^2) : power:0.4,0.3' --x0 1.2,0 --v0 "
            "0.3,0.8 --method fvi-lobatto4 --h 0.05 --steps 80 --columns "
            "t,strut.force,strut.work,balance,work-strut.work,v,a"),
        0);
    ck_assert_near(cell(80, 1), -0.19270875, 3e-7, "force");
    ck_assert_near(cell(80, 2), 0.37770794615836, 3e-9, "work");
    ck_assert_near(cell(80, 3), 0.445, 3e-9, "balance");
    ck_assert(cell(80, 4) == 0 && cell(0, 1) == 0);
    /* a = -grad U - lambda x / r, U = 2 (r - 1)^2 + x2, at the end */
    ck_assert_int_eq(
        fvi("run --lagrangian '(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2 - x2' "
            "--damper 'strut=sqrt(x1^2+x2^2) : power:0.4,0.3' --x0 1.2,0 --v0 "
            "0.3,0.8 --method fvi-lobatto4 --h 0.05 --steps 80 --columns "
            "'q=(4*(sqrt(x1^2+x2^2)-1)+strut.force)/sqrt(x1^2+x2^2),a1+q*x1,"
            "a2+1+q*x2'"),
        0);
    ck_assert_near(cell(80, 1), 0, 3e-6, "a1");
    ck_assert_near(cell(80, 2), 0, 3e-6, "a2");
}
END_TEST

/* Dampers of a folder: by a matrix one force on each unknown, along a row one force; with fvi the
 * same numbers as between the coordinates of two masses. */
START_TEST(dampers_of_a_folder_have_their_forces)
{
    const char *rest = "--damper 'top=x2-x1 : viscous:0.1' --x0 0.3,0.1 --p0 "
                       "0.2,0 --force 'sin(t)' --method fvi --h 0.05 --steps "
                       "100 --columns "
                       "t,a,base.force,top.force,base.work,top.work,balance";
    char line[500];
    double want[8];
    snprintf(line, sizeof line, "run --mass 2,1 --potential '5*x1^2+5*(x2-x1)^2' "
             "--damper 'base=x1 : power:0.5,0.3' %s", rest);
    ck_assert_msg(fvi(line) == 0, "%s", err);
    for (size_t n = 0; n < 8; n++)
        want[n] = cell(100, n);
    ck_assert_int_eq(
        shell("mkdir -p c && cd c && for m in 'M 2\n1 1 2\n2 2 1' "
              "'K 3\n1 1 20\n2 1 -10\n2 2 10' 'C2 1\n1 1 0.5'; do printf "
              "\"%%%%MatrixMarket matrix coordinate real symmetric\n2 2 ${m#* }"
              "\n\" > ${m%% *}.mtx; done"),
        0);
    snprintf(line, sizeof line, "run --system c --damper 'base=C2.mtx : "
             "power:1,0.3' %s", rest);
    ck_assert_msg(fvi(line) == 0, "%s", err);
    ck_assert_ptr_nonnull(strstr(out, "\n# t\ta1\ta2\tbase.force1\tbase.force2\t"
                                      "top.force\tbase.work\ttop.work\t"
                                      "balance\n"));
    for (size_t n = 0; n < 8; n++)
        ck_assert_near(cell(100, n + (n > 3)), want[n], 1e-12, "%zu", n);
    ck_assert(cell(100, 4) == 0);
}
END_TEST

/* One coordinate, all formats; a comma in a name is quoted where commas part columns. */
START_TEST(names_of_columns_survive_every_format)
{
    const char *rest = "run --steps 2 --columns 't,max(x,p),d1.force,s=sign(v)' "
                       "--format ";
    char line[200];
    snprintf(line, sizeof line, "%scsv", rest);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert(strncmp(out, "t,\"max(x,p)\",d1.force,s\n0,1,0.1,1\n", 34) == 0);
    snprintf(line, sizeof line, "%sjson", rest);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_ptr_nonnull(strstr(
        out, "\"columns\": [\"t\", \"max(x,p)\", \"d1.force\", \"s\"]"));
    ck_assert_ptr_nonnull(strstr(out, "\n [0, 1, 0.1, 1],\n"));
    /* an expression on two lines, or with a tab, has its name in one */
    ck_assert_int_eq(fvi("run --columns 't,2*x\n+p' --steps 1 --format json"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\"columns\": [\"t\", \"2*x +p\"]"));
    ck_assert_int_eq(fvi("run --columns 't,2*\tx' --steps 1"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\n# t\t2* x\n"));
    ck_assert_int_eq(fvi("run --reduce 'max(x\n+p)' --steps 1 --format csv"), 0);
    ck_assert(strncmp(out, "max(x +p)\n", 10) == 0);
}
END_TEST

/* Plain columns are as they were beside typed ones, and a vector is one column for each unknown. */
START_TEST(plain_columns_stay_what_they_are)
{
    ck_assert_int_eq(fvi_two("run", "--columns t,x,p,energy,y --every 50"), 0);
    double x[11][8];
    for (size_t k = 0; k <= 10; k++)
        for (size_t n = 0; n < 8; n++)
            x[k][n] = cell(k, n);
    ck_assert_int_eq(fvi_two("run", "--columns t,x,p,energy,y,v,a,d1.force,F "
                                    "--every 50"),
                     0);
    ck_assert_ptr_nonnull(strstr(out, "\ty1\ty2\tv1\tv2\ta1\ta2\td1.force1\t"
                                      "d1.force2\tF1\tF2\n"));
    for (size_t k = 0; k <= 10; k++) {
        for (size_t n = 0; n < 8; n++)
            ck_assert(cell(k, n) == x[k][n]);
        ck_assert(cell(k, 8) == cell(k, 3) && cell(k, 9) == cell(k, 4));
        ck_assert_ulp(cell(k, 14), -sin(8 * cell(k, 0)), 1, "F");
    }
    ck_assert_int_eq(fvi_two("run", "--columns t,v,x1 --unknowns 2 --every 250"),
                     0);
    ck_assert_ptr_nonnull(strstr(out, "\n# t\tv2\tx1\n"));
}
END_TEST

/* A run that goes on has its sums: the rest of the table is that of a run that was not stopped. */
START_TEST(sums_stand_in_the_checkpoint)
{
    static const char *const methods[] = {
        "fvi-bdf2 --memory direct", "fvi-lobatto3 --memory direct"
    };
    char line[500];
    for (size_t i = 0; i < LEN(methods); i++) {
        const char *rest = "--alpha 0.3 --h 0.05 --every 100 --columns "
                           "t,work,d1.force,a,balance";
        snprintf(line, sizeof line,
                 "rm -f s; $FVI run --method %s %s --steps 200 --checkpoint s && "
                 "$FVI run --method %s %s --steps 400 --checkpoint s --continue",
                 methods[i], rest, methods[i], rest);
        ck_assert_int_eq(shell(line), 0);
        char *both = strdup(out);
        snprintf(line, sizeof line, "run --method %s %s --steps 400",
                 methods[i], rest);
        ck_assert_int_eq(fvi(line), 0);
        const char *last = strstr(out, "\n15\t");
        ck_assert_ptr_nonnull(last);
        ck_assert_ptr_nonnull(strstr(both, last));
        free(both);
    }
    ck_assert_int_eq(shell("rm -f s; $FVI run --memory direct --steps 4 --checkpoint s"), 0);
    ck_assert_int_eq(shell("$FVI run --memory direct --steps 8 --checkpoint s --continue "
                           "--columns t,work"),
                     2);
    ck_assert_ptr_nonnull(strstr(err, "columns with sums"));
    /* a velocity is no sum: it may follow, and no step is done again */
    ck_assert_int_eq(shell("$FVI run --memory direct --steps 8 --checkpoint s --continue "
                           "--columns t,v"),
                     0);
    ck_assert_str_eq(err, "");
    ck_assert_uint_eq(count_rows(), 4);
    ck_assert_int_eq(shell("rm -f s; $FVI run --memory direct --steps 4 --checkpoint s --columns t,v"),
                     0);
    ck_assert_int_eq(fvi("run --memory direct --steps 8 --checkpoint s --continue"), 0);
    ck_assert_str_eq(err, "");
}
END_TEST

START_TEST(what_no_column_is_is_refused)
{
    static const struct {
        const char *line, *said;
    } cases[] = {
        { "run --columns t,vv", "--columns: 'vv' is none of t, x, p, v, a, F, "
                                "energy, work, balance, y, d1.force, nor an "
                                "expression; did you mean v?" },
        { "run --columns d1.forc", "--columns: 'd1.forc' is none of t, x, p, v, "
                                   "a, F, energy, work, balance, y, d1.force, "
                                   "nor an expression; did you mean d1.force?" },
        { "run --columns ag", "--columns: 'ag' is none of t" },
        { "run --columns t,,x", "--columns: 't,,x': a column is missing" },
        { "run --columns v=x", "--columns: 'v' is a quantity's own name; take "
                               "another" },
        { "run --columns sin=x", "--columns: 'sin' is not a name for a column" },
        { "run --columns y=x", "--columns: 'y' is a quantity's own name" },
        { "run --columns q=x,q=v", "--columns: 'q' is given to two columns" },
        { "run --columns v,v", "--columns: 'v' names v twice" },
        { "run --columns t,t", "--columns: 't,t' names t twice" },
        { "run --let k=1 --columns t,k=x",
          "--columns: 'k' is a parameter of --let, too" },
        { "run --let k=1 --columns t,v", "--let: 'k' is in no expression" },
        { "run --potential chain:2,1,1 --columns 'q=x'",
          "--columns: 'x' of which coordinate? x1 to x2" },
        { "run --reduce 'mx(x)'", "--reduce: 'mx(x)' is not min, max, absmax, "
                                  "mean, rms, last, first or peak of an "
                                  "expression, in parentheses, nor at(...) of "
                                  "one; did you mean max?" },
        { "run --reduce 'max(x'", "--reduce: 'max(x' is not min, max, absmax, "
                                  "mean, rms, last, first or peak of an "
                                  "expression, in parentheses, nor at(...) of "
                                  "one\n" },
        { "run --reduce 'max(x,p)'", "--reduce: 'max(x,p)' takes one expression" },
        { "run --reduce 'at(mean(x))'", "--reduce: 'mean(x)' has no time of its "
                                        "own" },
        { "run --reduce 'at(at(max(x)))'", "--reduce: 'at(max(x))' is not" },
        { "run --reduce 'max(x)*2'", "--reduce: 'max(x)*2' is not" },
        { "run --reduce 'max(x),max(x)'", "--reduce: 'max(x)' is asked for "
                                          "twice" },
        { "run --reduce ''", "--reduce: '' is not" },
        { "run --reduce 'max(x)' --every 3", "--every: not together with --reduce" },
        { "run --reduce 'max(x)' --columns t,x", "--columns: 't' is of no use to --reduce" },
        { "run --reduce 'max(ee)' --columns 'e=x,ee=x^2'", "--columns: 'e=x' is" },
        { "run --reduce 'max(e)' --columns 'e=x^2,max(x,p)'",
          "--columns: 'max(x,p)' is of no use to --reduce" },
        { "exact --columns t,work", "--columns: 't,work': the work of dampers" },
    };
    for (size_t i = 0; i < LEN(cases); i++) {
        char said[300];
        snprintf(said, sizeof said, "fvi: %s", cases[i].said);
        ck_assert_msg(fvi(cases[i].line) == 2, "%s", cases[i].line);
        ck_assert_str_eq(out, "");
        ck_assert_msg(strncmp(err, said, strlen(said)) == 0, "%s: %s",
                      cases[i].line, err);
    }
    ck_assert_refused_at("run --columns 't,q=2*vv'",
                         "fvi: --columns: '2*vv': no such name\n"
                         "                   ^");
    ck_assert_refused_at("run --reduce 'max(x+)'",
                         "fvi: --reduce: 'x+': it ends too early\n"
                         "                  ^");
}
END_TEST

/* v, F and the energy need no sums: exact and --error have them. */
START_TEST(a_state_alone_has_its_columns_too)
{
    ck_assert_int_eq(fvi("exact --mass 2 --force cosine:1,2 --steps 4 --columns "
                         "t,v,p,F,energy-v^2-x^2/2,q=2*v"),
                     0);
    for (size_t k = 0; k <= 4; k++) {
        ck_assert(cell(k, 1) == cell(k, 2) / 2 && cell(k, 5) == cell(k, 2));
        ck_assert_ulp(cell(k, 3), cos(2 * cell(k, 0)), 1, "F");
        ck_assert_near(cell(k, 4), 0, 4 * U, "energy");
    }
    ck_assert_int_eq(fvi("run --steps 2 --columns balance"), 0);
    ck_assert(cell(0, 0) == 0.625);
    ck_assert_int_eq(fvi("run --error 1e-8 --time 2 --steps 4 --columns "
                         "t,v-p,energy"),
                     0);
    ck_assert(cell(4, 0) == 2 && cell(4, 1) == 0);
}
END_TEST

/* With --error the run that was found is made again for them: x has the digits of a run without. The
 * force is that of another method, 1e-6 being ten times what fvi-bdf2 is right to. */
START_TEST(a_wanted_error_has_all_columns)
{
    static const char *const methods[] = { "fvi-adaptive", "fvi-lobatto4",
                                           "fvi-bdf2" };
    double force = 0;
    for (size_t i = 0; i < LEN(methods); i++) {
        char line[200];
        double x[5];
        snprintf(line, sizeof line, "run --error 1e-7 --alpha 0.3 --time 2 --steps "
                 "4 --method %s --columns x", methods[i]);
        ck_assert_int_eq(fvi(line), 0);
        for (size_t k = 0; k <= 4; k++)
            x[k] = cell(k, 0);
        snprintf(line, sizeof line, "run --error 1e-7 --alpha 0.3 --time 2 --steps "
                 "4 --method %s --columns t,x,d1.force,balance,a+x+d1.force",
                 methods[i]);
        ck_assert_msg(fvi(line) == 0, "%s", err);
        for (size_t k = 0; k <= 4; k++) {
            ck_assert(cell(k, 1) == x[k]);
            ck_assert_near(cell(k, 3), 0.625, 1e-6, "balance");
            ck_assert_near(cell(k, 4), 0, 1e-9, "the equation of motion");
        }
        if (i == 0)
            force = cell(4, 2);
        ck_assert_near(cell(4, 2), force, 1e-6, "%s", methods[i]);
    }
    ck_assert_int_eq(fvi("sweep --vary alpha=0.3 --error 1e-7 --time 2 --steps 4 "
                         "--columns d1.force"),
                     0);
    ck_assert(cell(0, 1) == force);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: columns");
    ADD_CASE(suite, "columns", drifts_floors_and_forces_are_columns,
             a_damper_between_two_points_has_its_force,
             dampers_of_a_folder_have_their_forces,
             names_of_columns_survive_every_format,
             plain_columns_stay_what_they_are, sums_stand_in_the_checkpoint,
             a_state_alone_has_its_columns_too, a_wanted_error_has_all_columns);
    ADD_CASE(suite, "refused", what_no_column_is_is_refused);
    return run_suite_of_program(suite);
}
