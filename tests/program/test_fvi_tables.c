/* tests/program/test_fvi_tables.c -- The program build/fvi: tables that it reads and writes.
 * Run alone: make test-fvi_tables */
#define _GNU_SOURCE
#include "program.h"
#include "folder.h"

/* Row k of the motion: x = t^2 at four times, in a shape of its own. */
static const char *const same[] = {
    "t\tx\n0\t1\n0.5\t0.25\n1\t-0.5\n2\t1.5\n",
    "t,x\n0,1\n0.5,0.25\n1,-0.5\n2,1.5\n",
    "t;x\n0;1\n0,5;0,25\n1;-0,5\n2;1,5\n",
    "t;x\n0;1\n0.5;0.25\n1;-0.5\n2;1.5\n",
    "\"x\" ; \"t\"\r\n1 ; 0\r\n,25 ; 0,5\r\n-5e-1 ; 1,\r\n+1,5e0 ; 2\r\n",
    "time (s);t;x\n9;0;1\n9;0,5;0,25\n9;1;-0,5\n9;2;1,5\n",
    "place (m, s)\tt\tx\n9\t0\t1\n9\t.5\t.25\n9\t1\t-.5\n9\t2\t1.5\n",
    "  0 1 # the start\n\n.5   0.25\n  1 -0.5 # \n2 \t 1.5\n# end\n",
    "0,1,\n0.5, 0.25,\n1 , -0.5,\n2,1.5,\n,,\n",
    "\tt\tx\n0\t0\t1\n1\t0.5\t0.25\n2\t1\t-0.5\n3\t2\t1.5",
};

/* One table in ten shapes gives one fit, and one run as a force. */
START_TEST(a_table_is_the_same_in_every_shape)
{
    char *fitted = NULL, *forced = NULL;
    for (size_t i = 0; i < LEN(same); i++) {
        write_file("d", same[i]);
        /* Four points show no motion, and the fit says so; here it counts what was read. */
        const int status = fvi("fit --h 0.1 --fit x0 --starts 2 d");
        ck_assert_msg(status == 1 && strstr(out, "\nx0\t")
                          && strstr(out, "\n# flag = no motion is seen"),
                      "%s: %s", same[i], err);
        ck_assert_msg(!fitted || strcmp(out, fitted) == 0, "%s", same[i]);
        free(fitted);
        fitted = strdup(out);
        ck_assert_int_eq(shell("sed '1s/x/F/' d > F; \"$FVI\" run --h .1 "
                               "--steps 20 --force file:F"),
                         0);
        ck_assert_msg(!forced || strcmp(out, forced) == 0, "%s", same[i]);
        free(forced);
        forced = strdup(out);
    }
    free(fitted);
    free(forced);
}
END_TEST

/* What is no table is refused with file, line and column, by whatever option. */
static const struct {
    const char *text, *where;
} wrong[] = {
    { "0 1\n10 2 oops\n30 1\n", ":2:6: not a finite decimal number" },
    { "0 1\n10 2 7\n30 1\n", ":2:6: more numbers than columns" },
    { "0 1 7\n10 2\n30 1 7\n", ":2:5: a number is missing" },
    { "0\n30\n", ":1:2: a number is missing" },
    { "-5x 2\n0 1\n30 1\n", ":1:1: not a finite decimal number" },
    { "0 1\n0x10 2\n30 1\n", ":2:1: not a finite decimal number" },
    { "0 1\n10 0x1p3\n30 1\n", ":2:4: not a finite decimal number" },
    { "0 1\n10 infinity\n30 1\n", ":2:4: not a finite decimal number" },
    { "0\t1\n10\t\t2\n30\t1\n", ":2:4: an empty field" },
    { "0\t1\n\t10\t2\n30\t1\n", ":2:1: an empty field" },
    { "0,1\n10,,2\n30,1\n", ":2:4: an empty field" },
    { "0;1\n;10;2\n30;1\n", ":2:1: an empty field" },
    { "0 1,5\n30 1,5\n", ":1:4: numbers are separated in two ways" },
    { "0\t1,5\n30\t1,5\n", ":1:4: numbers are separated in two ways" },
    { "0,5 1,5\n30,0 1,5\n", ":1:4: numbers are separated in two ways" },
    { "0,1\n10;2\n30,1\n", ":2:3: numbers are separated in two ways" },
    { "0,1\n10 2\n30,1\n", ":2:3: numbers are separated in two ways" },
    { "0;1\n10;2,5\n30;1.5\n", ":3:5: a decimal point, where others are" },
    { "0;1.5\n10;2,5\n", ":2:5: a decimal comma, where others are" },
    { "0;1.000,5\n30;1\n", ":1:3: not a finite decimal number" },
    { "t;F\n0,1\n30,1\n", ":2:1: not as many numbers as names above" },
    { "t F\n0 1 2\n30 1 2\n", ":2:1: not as many numbers as names above" },
    { "0 1\r30 2\r", ":1:4: a carriage return within the line" },
    { "0 1\n5 6\nt F\n30 1\n", ":3:1: not a finite decimal number" },
    { "0 1e999\n30 1\n", ":1:3: not a finite decimal number" },
    { "0 1_0\n30 1\n", ":1:3: not a finite decimal number" },
};

START_TEST(what_is_no_table_is_refused_with_line_and_column)
{
    static const char *const lines[][2] = {
        { "run --force file:d", "--force: d" }, { "fit d", "DATA: d" }
    };
    for (size_t i = 0; i < LEN(wrong); i++)
        for (size_t k = 0; k < LEN(lines); k++) {
            char said[100];
            write_file("d", wrong[i].text);
            if (k == 1 && strchr(wrong[i].text, 'F'))
                ck_assert_int_eq(shell("sed -i s/F/x/ d"), 0);
            snprintf(said, sizeof said, "fvi: %s%s", lines[k][1],
                     wrong[i].where);
            ck_assert_refused_with(lines[k][0], said);
        }
    ck_assert_int_eq(shell("printf '0 1\\n3\\0000 1\\n' > d"), 0);
    ck_assert_refused("run --force file:d",
                      "fvi: --force: d:2:2: a NUL byte: this is no text");
}
END_TEST

/* The start, and the forces of a folder, are read by the same reader. */
START_TEST(lists_and_folders_are_read_as_tables_are)
{
    ck_assert_int_eq(fvi("run --dimension 2 --potential x1*x2 --x0 1,1.5"), 0);
    char *want = strdup(strstr(out, "\n0\t"));
    write_file("x", "1;1,5 # both\n");
    ck_assert_int_eq(fvi("run --dimension 2 --potential x1*x2 --x0 @x"), 0);
    ck_assert_str_eq(strstr(out, "\n0\t"), want);
    free(want);
    write_file("x", "1 1,5\n");
    ck_assert_refused_with("run --dimension 2 --potential x1*x2 --x0 @x",
                           "fvi: --x0: x:1:4: numbers are separated in two");
    write_file("x", "0x10\n");
    ck_assert_refused("run --x0 @x",
                      "fvi: --x0: x:1:1: not a finite decimal number");
    write_file("x", "1 2 oops\n");
    ck_assert_refused("run --p0 @x",
                      "fvi: --p0: x:1:5: not a finite decimal number");
    write_chain();
    write_file("chain/f.tsv", "t f2\n0 0.5\n20 1.5\n");
    ck_assert_int_eq(fvi("run --system chain"), 0);
    want = strdup(strstr(out, "\n0\t"));
    write_file("chain/f.tsv", "t;f2\n0;0,5\n20;1,5\n");
    ck_assert_int_eq(fvi("run --system chain"), 0);
    ck_assert_str_eq(strstr(out, "\n0\t"), want);
    free(want);
    write_file("chain/f.tsv", "t\tf2\n0\t0,5\n20\t1,5\n");
    ck_assert_refused_with("run --system chain",
                           "fvi: --system: chain/f.tsv:2:4: numbers are");
    write_file("chain/f.tsv", "t\tf2\n0\t\n20\t1.5\n");
    ck_assert_refused("run --system chain",
                      "fvi: --system: chain/f.tsv:2:3: a number is missing");
    ck_assert_int_eq(shell("rm -r chain"), 0);
}
END_TEST

/* Devices and pipes never end: what is read of them is bounded, and so is a line. (A sanitizer
 * wants more memory than the limit.) */
START_TEST(what_never_ends_is_refused_in_little_memory)
{
    static const struct {
        const char *words, *said;
    } endless[] = {
        { "run --force file:/dev/zero", "--force: /dev/zero:1:1: a NUL byte" },
        { "run --x0 @/dev/zero", "--x0: /dev/zero:1:1: a NUL byte" },
        { "fit /dev/urandom", "DATA: /dev/urandom:" },
        { "run --force file:/dev/full", "--force: /dev/full:1:1: a NUL byte" },
        { "run --system folder", "--system: folder/M.mtx:1:1: a NUL byte" },
        { "run --force file:ones",
          "--force: ones:1:67108865: a line of more than 64 MiB" },
        { "run --x0 @lines",
          "--x0: lines:262145:1: more than 256 MiB from what is no ordinary "
          "file" },
    };
    ck_assert_int_eq(shell("mkfifo ones lines; mkdir folder; "
                           "ln -s /dev/zero folder/M.mtx"),
                     0);
    for (size_t i = 0; i < LEN(endless); i++) {
        char line[500];
        snprintf(line, sizeof line,
                 "(yes 1 | tr -d '\\n' > ones) 2> /dev/null & one=$!; "
                 "(yes \"$(printf '#%%1022s')\" > lines) 2> "
                 "/dev/null & two=$!; ulimit -Sv 1000000; "
                 "sh -c '\"$FVI\" --version; exit $?' > version 2>&1 || "
                 "ulimit -Sv unlimited; \"$FVI\" %s; "
                 "status=$?; kill $one $two; exit $status",
                 endless[i].words);
        ck_assert_int_eq(shell(line), 2);
        ck_assert_msg(strncmp(err + 5, endless[i].said, strlen(endless[i].said))
                          == 0,
                      "%s", err);
    }
}
END_TEST

/* Three forms, the same numbers. */
START_TEST(tables_in_three_formats)
{
    ck_assert_int_eq(fvi("run --h 0.5 --steps 1 --format CSV"), 0);
    ck_assert(strncmp(out, "t,x,p,energy\n0,1,0.5,0.625\n0.5,", 31) == 0);
    ck_assert_uint_eq(count_lines(out), 3);
    ck_assert_int_eq(fvi("run --h 0.5 --steps 1 --format json --columns t,y "
                         "--alpha .5 --let 'k=1,c=\"'"),
                     2);
    ck_assert_int_eq(fvi("run --h 0.5 --steps 1 --format json --columns x,t,y "
                         "--alpha .5 --potential harmonic --dimension 2 "
                         "--x0 1,0"),
                     0);
    ck_assert_ptr_nonnull(strstr(out, "\"alpha\": 0.5,\n"));
    ck_assert_ptr_nonnull(strstr(out, "\"x0\": \"1,0\",\n"));
    ck_assert_ptr_nonnull(
        strstr(out, " },\n\"columns\": [\"x1\", \"x2\", \"t\", \"y1\", "
                    "\"y2\"],\n\"rows\": [\n [1, 0, 0, "));
    ck_assert_str_eq(strrchr(out, '\n') - 3, "\n]}\n");
    ck_assert_int_eq(fvi("coefficients --count 2 --format csv"), 0);
    ck_assert_str_eq(out, "n,w_n\n0,1\n1,-0.5\n");
    ck_assert_int_eq(fvi("exact --steps 1 --format csv --columns t"), 0);
    ck_assert_str_eq(out, "t\n0\n0.1\n");
}
END_TEST

/* A file's name is bytes; in JSON stand characters. */
START_TEST(a_name_of_any_bytes_is_json)
{
    ck_assert_int_eq(
        shell("f=$(printf 'a\\377\\303\\251\\300\\257\\355\\240\\200\\364\\220"
              "\\200\\200\\360\\237\\230\\200\\342'); printf '0 1\\n9 1\\n' > "
              "\"$f\"; "
              "\"$FVI\" run --steps 1 --force \"file:$f\" --format json"),
        0);
    ck_assert_ptr_nonnull(
        strstr(out, "\"force\": \"file:a\\ufffd\303\251\\ufffd\\ufffd"
                    "\\ufffd\\ufffd\\ufffd\\ufffd\\ufffd\\ufffd\\ufffd"
                    "\360\237\230\200\\ufffd\""));
}
END_TEST

/* The head has the words as the program knows them, however they are typed. */
START_TEST(the_head_has_its_own_words)
{
    ck_assert_int_eq(fvi("run --method FVI-Stable --derivative HELD --memory "
                         "Direct --steps 1"),
                     0);
    ck_assert_ptr_nonnull(strstr(out, "# method = fvi-stable\n"));
    ck_assert_ptr_nonnull(strstr(out, "# derivative = held\n"));
    ck_assert_ptr_nonnull(strstr(out, "# memory = direct\n"));
}
END_TEST

/* What other programs make of it: Python's json, numpy with names, gnuplot's columns by
 * name. Those that are not installed are not asked. */
START_TEST(other_programs_read_the_tables)
{
    ck_assert_int_eq(
        shell("command -v python3 > /dev/null || exit 0; \"$FVI\" run --alpha "
              "0.3 --format json > j; \"$FVI\" run --alpha 0.3 > t; python3 -c "
              "'import json; j = json.load(open(\"j\")); rows = [[float(v) for "
              "v in l.split()] for l in open(\"t\") if l[0] != \"#\"]; assert "
              "j[\"rows\"] == rows and len(rows) == 201 and j[\"columns\"] == "
              "[\"t\", \"x\", \"p\", \"energy\"] and "
              "j[\"parameters\"][\"alpha\"] == 0.3'"),
        0);
    ck_assert_int_eq(
        shell("/usr/bin/python3 -c 'import numpy' 2> /dev/null || exit 0; "
              "\"$FVI\" run --format csv > c; \"$FVI\" run > t; "
              "/usr/bin/python3 -c 'import numpy as n; a = n.genfromtxt(\"c\", "
              "delimiter=\",\", names=True); b = n.genfromtxt(\"t\"); assert "
              "a.dtype.names == (\"t\", \"x\", \"p\", \"energy\") and "
              "(a[\"energy\"] == b[:, 3]).all()'"),
        0);
    ck_assert_int_eq(
        shell("command -v gnuplot > /dev/null || exit 0; \"$FVI\" run --format "
              "csv > c; gnuplot -e 'set datafile separator comma; set key "
              "autotitle columnhead; stats \"c\" using \"t\":\"energy\" "
              "nooutput; print STATS_records' 2>&1 | grep -qx 201"),
        0);
}
END_TEST

/* The shortest digits come back as the same double, and no shorter ones do. */
START_TEST(digits_are_the_fewest_that_come_back)
{
    ck_assert_int_eq(fvi("run --steps 500 --alpha 0.3 --columns x,p,energy "
                         "--x0 0.1 --p0 1e-310 --potential free --rho 0"),
                     0);
    ck_assert(strncmp(first_row(), "0.1\t1e-310\t0\n", 12) == 0);
    ck_assert_int_eq(fvi("run --steps 500 --alpha 0.3 --columns x,p"), 0);
    size_t fewer = 0;
    for (const char *at = first_row(); *at;) {
        char *end, text[40];
        const double v = strtod(at, &end);
        const size_t length = (size_t)(end - at);
        snprintf(text, sizeof text, "%.17g", v);
        ck_assert(length <= strlen(text));
        fewer += length < strlen(text);
        for (int digits = 1; digits <= 17; digits++) {
            snprintf(text, sizeof text, "%.*g", digits, v);
            if (strtod(text, NULL) == v)
                break;
        }
        ck_assert_msg(strlen(text) == length, "%.*s", (int)length, at);
        at = end + 1;
    }
    ck_assert_uint_gt(fewer, 300);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: tables");
    ADD_CASE(suite, "tables", a_table_is_the_same_in_every_shape,
             what_is_no_table_is_refused_with_line_and_column,
             lists_and_folders_are_read_as_tables_are,
             what_never_ends_is_refused_in_little_memory);
    ADD_CASE(suite, "answers", tables_in_three_formats,
             a_name_of_any_bytes_is_json, the_head_has_its_own_words,
             other_programs_read_the_tables,
             digits_are_the_fewest_that_come_back);
    return run_suite_of_program(suite);
}
