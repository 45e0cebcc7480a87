/* tests/structures/test_structures_files.c -- Matrices from triplets and from files.
 * Run alone: make test-structures_files */
#define _GNU_SOURCE /* mkstemp */
#include "structures_runs.h"

#include <suitesparse/cholmod.h>
#include <unistd.h>

/* ---- sums of triplets ---- */

START_TEST(triplets_sum_in_any_order)
{
    const fvi_triplet list[] = { { 2, 0, 5 }, { 0, 0, 1 },  { 0, 2, 5 },
                                 { 1, 1, 3 }, { 0, 0, 10 }, { 2, 2, 7 },
                                 { 1, 1, -3 } };
    fvi_sparse A;
    OK(fvi_sparse_assemble(3, LEN(list), list, &A));
    ck_assert_int_eq(A.start[3], 5); /* (1, 1) has stayed, as zero */
    ck_assert(A.row[0] == 0 && A.row[1] == 2 && A.entry[0] == 11);
    const double x[3] = { 1, 2, 3 }, want[3] = { 26, 0, 26 };
    double y[3];
    fvi_sparse_multiply(&A, x, y);
    for (int i = 0; i < 3; i++)
        ck_assert(y[i] == want[i]);
    fvi_sparse_free(&A);
}
END_TEST

START_TEST(bad_triplets_are_refused)
{
    const fvi_triplet good[] = { { 0, 0, 1 } };
    const fvi_triplet bad[][1] = { { { 2, 0, 1 } },
                                   { { 0, 2, 1 } },
                                   { { -1, 0, 1 } },
                                   { { 0, -1, 1 } },
                                   { { 0, 0, NAN } } };
    fvi_sparse A = { .n = 77 };
    for (size_t i = 0; i < LEN(bad); i++)
        ck_assert_int_eq(fvi_sparse_assemble(2, 1, bad[i], &A), FVI_EDOM);
    ck_assert_int_eq(fvi_sparse_assemble(0, 1, good, &A), FVI_EINVAL);
    ck_assert_int_eq(fvi_sparse_assemble((size_t)1 << 31, 1, good, &A), FVI_EINVAL);
    ck_assert_int_eq(fvi_sparse_assemble(2, 1, NULL, &A), FVI_EFAULT);
    ck_assert_int_eq(fvi_sparse_assemble(2, 1, good, NULL), FVI_EFAULT);
    ck_assert_uint_eq(A.n, 77);
}
END_TEST

/* ---- files ---- */

static const char *write_file(const char *text)
{
    static char name[] = "/tmp/fvi-structures-XXXXXX";
    strcpy(name + strlen(name) - 6, "XXXXXX");
    const int file = mkstemp(name);
    ck_assert(file >= 0);
    ck_assert(write(file, text, strlen(text)) == (ssize_t)strlen(text));
    close(file);
    return name;
}

#define HEAD "%%MatrixMarket matrix coordinate real symmetric\n"
#define GENERAL "%%MatrixMarket matrix coordinate real general\n"

START_TEST(a_file_is_the_matrix_that_it_says)
{
    static const char *const files[] = {
        HEAD "% comment\n\n2 2 3\n1 1 2\n2 1 -1e0\n% more\n2 2 0.5\n",
        HEAD "2 2 3\n2 2 .5e0\n1 2 -1\n1 1 2", /* the upper triangle */
        GENERAL "2 2 4\n1 2 -1\n2 2 .5\n1 1 2\n\t2  1\t-1 \r\n",
        "%%matrixmarket matrix coordinate real symmetric\n1 1 1\n1 1 2\n"
    };
    for (size_t i = 0; i < LEN(files); i++) {
        fvi_sparse A;
        fvi_misread wrong = { 0, "", 0 };
        const char *name = write_file(files[i]);
        const int status = fvi_sparse_read(name, &A, &wrong);
        remove(name);
        if (i == 3) { /* the first word is written so, and no other way */
            ck_assert_int_eq(status, FVI_EDOM);
            continue;
        }
        ck_assert_msg(status == FVI_SUCCESS, "file %zu: %zu: %s", i, wrong.line,
                      wrong.reason);
        ck_assert(A.n == 2 && A.start[1] == 2 && A.start[2] == 4);
        ck_assert(A.entry[0] == 2 && A.entry[1] == -1 && A.entry[2] == -1
                  && A.entry[3] == 0.5);
        fvi_sparse_free(&A);
    }
}
END_TEST

/* Of each file the line, and a word of the reason. */
START_TEST(bad_files_are_refused_with_their_line)
{
    static const struct {
        const char *text, *reason;
        size_t line;
    } bad[] = {
        { "", "empty", 0 },
        { "hello\n", "head", 1 },
        { "\n" HEAD "1 1 1\n1 1 1\n", "head", 1 },
        { "%%MatrixMarket matrix coordinate real symmetric too\n", "head", 1 },
        { "%%MatrixMarket vector coordinate real general\n", "not a matrix",
          1 },
        { "%%MatrixMarket matrix array real symmetric\n1 1\n1\n", "dense", 1 },
        { "%%MatrixMarket matrix coordinate pattern symmetric\n1 1 1\n1 1\n",
          "pattern", 1 },
        { "%%MatrixMarket matrix coordinate complex symmetric\n", "real", 1 },
        { "%%MatrixMarket matrix coordinate real skew-symmetric\n", "symmetric",
          1 },
        { HEAD, "size", 0 },
        { HEAD "1 1\n", "size", 2 },
        { HEAD "1 1 1 1\n", "size", 2 },
        { HEAD "2 3 0\n", "square", 2 },
        { HEAD "0 0 0\n", "1 to 2^31", 2 },
        { HEAD "1 1 -1\n", "1 to 2^31", 2 },
        { HEAD "2 2 2\n1 1 1\n", "fewer", 2 },
        { HEAD "2 2 1\n1 1 1\n2 2 1\n", "more", 4 },
        { HEAD "2 2 1\n1 1\n", "a finite decimal number", 3 },
        { HEAD "2 2 1\n1 1 one\n", "a finite decimal number", 3 },
        { HEAD "2 2 1\n1 1 1 1\n", "a finite decimal number", 3 },
        { HEAD "2 2 1\n1,1,1\n", "a finite decimal number", 3 },
        { HEAD "2 2 1\n3 1 1\n", "not there", 3 },
        { HEAD "2 2 1\n1 0 1\n", "not there", 3 },
        { HEAD "2 2 1\n1 1.5 1\n", "not there", 3 },
        { HEAD "2 2 1\n1 1 nan\n", "finite", 3 },
        { HEAD "2 2 1\n1 1 0x10\n", "decimal", 3 },
        { HEAD "0x2 2 1\n1 1 1\n", "size", 2 },
        { HEAD "2 2 1\n1 1 1e999\n", "finite", 3 },
        { HEAD "2 2 3\n1 1 1\n2 1 3\n1 2 3\n", "one triangle", 5 },
        { HEAD "2 2 3\n1 1 1\n2 2 3\n1 1 3\n", "twice", 5 },
        { GENERAL "2 2 3\n1 1 1\n2 1 3\n2 1 3\n", "twice", 5 },
        { GENERAL "2 2 2\n1 1 1\n2 1 3\n", "not symmetric", 4 },
        { GENERAL "2 2 3\n1 1 1\n1 2 3\n2 1 4\n", "not symmetric", 5 },
    };
    for (size_t i = 0; i < LEN(bad); i++) {
        fvi_sparse A = { .n = 77 };
        fvi_misread wrong = { 99, "", 99 };
        const char *name = write_file(bad[i].text);
        const int status = fvi_sparse_read(name, &A, &wrong);
        remove(name);
        ck_assert_msg(status == FVI_EDOM && wrong.line == bad[i].line
                          && strstr(wrong.reason, bad[i].reason),
                      "%s: %d, line %zu: %s", bad[i].text, status, wrong.line,
                      wrong.reason);
        ck_assert_uint_eq(A.n, 77);
    }
    fvi_sparse A;
    ck_assert_int_eq(fvi_sparse_read("/nowhere", &A, NULL), FVI_EDOM);
    ck_assert_int_eq(fvi_sparse_read("/tmp", &A, NULL), FVI_EDOM);
    ck_assert_int_eq(fvi_sparse_read(NULL, &A, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_sparse_read("/nowhere", NULL, NULL), FVI_EFAULT);
}
END_TEST

/* ---- another reader ---- */

/* The entry (i, j), i <= j, that CHOLMOD reads; NaN if it refuses the file. */
static double read_by_cholmod(const char *text, int i, int j)
{
    cholmod_common common;
    const char *name = write_file(text);
    FILE *file = fopen(name, "r");
    cholmod_start(&common);
    common.print = 0;
    cholmod_sparse *A = cholmod_read_sparse(file, &common);
    double entry = A ? 0 : NAN;
    for (int e = A ? ((int *)A->p)[j] : 0; A && e < ((int *)A->p)[j + 1]; e++)
        if (((int *)A->i)[e] == i)
            entry = ((double *)A->x)[e];
    cholmod_free_sparse(&A, &common);
    cholmod_finish(&common);
    fclose(file);
    remove(name);
    return entry;
}

/* CHOLMOD reads a good file as we do; a file with both triangles it doubles, without a word. */
START_TEST(another_reader_agrees_where_the_file_is_good)
{
    const char *good = HEAD "2 2 3\n1 1 2\n2 1 -1.25\n2 2 0.1\n";
    fvi_sparse A;
    const char *name = write_file(good);
    OK(fvi_sparse_read(name, &A, NULL));
    remove(name);
    ck_assert(A.entry[1] == read_by_cholmod(good, 0, 1));
    ck_assert(A.entry[3] == read_by_cholmod(good, 1, 1));
    fvi_sparse_free(&A);
    ck_assert(read_by_cholmod(HEAD "2 2 4\n1 1 2\n2 1 -1.25\n1 2 -1.25\n"
                                   "2 2 0.1\n",
                              0, 1)
              == -2.5);
}
END_TEST

/* ---- a folder with dampers ---- */

static void write_into(const char *folder, const char *file, const char *text)
{
    char place[100];
    snprintf(place, sizeof place, "%s/%s", folder, file);
    FILE *f = fopen(place, "w");
    ck_assert_ptr_nonnull(f);
    fputs(text, f);
    fclose(f);
}

/* Each damper has its matrix, also one along a row, and a bad one is known by its number. */
START_TEST(dampers_of_a_folder_have_matrices_and_numbers)
{
    char folder[] = "/tmp/fvi_dampers_XXXXXX", place[100];
    static const char *const files[] = { "M.mtx", "K.mtx", "C.mtx" };
    const char *good[] = { "C.mtx : viscous:1", "x2-3*x1 : power:1,0.3" };
    const char *const bad[] = { "x1 : nonsense:1", "x1*x2 : viscous:1", "a/b.mtx : viscous:1" };
    fvi_directory *directory;
    fvi_error error;
    ck_assert_ptr_nonnull(mkdtemp(folder));
    for (size_t i = 0; i < LEN(files); i++)
        write_into(folder, files[i], HEAD "2 2 2\n1 1 2\n2 2 0.5\n");
    OK(fvi_directory_open_dampers(folder, 2, good, NULL, &directory, &error));
    const fvi_sparse *C = fvi_directory_damping(directory, 0),
                     *row = fvi_directory_damping(directory, 1);
    ck_assert(C->entry[0] == 2 && C->entry[1] == 0.5);
    ck_assert(row->entry[0] == 9 && row->entry[1] == -3 && row->entry[3] == 1);
    fvi_directory_close(directory);
    for (size_t i = 0; i < LEN(bad); i++) {
        good[1] = bad[i];
        ck_assert_int_eq(fvi_directory_open_dampers(folder, 2, good, NULL, &directory, &error),
                         FVI_EINVAL);
        ck_assert_str_eq(error.field, "damper");
        ck_assert_uint_eq(error.index, 1);
    }
    for (size_t i = 0; i < LEN(files); i++) {
        snprintf(place, sizeof place, "%s/%s", folder, files[i]);
        remove(place);
    }
    rmdir(folder);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("structures: files");
    ADD_CASE(suite, "sums", triplets_sum_in_any_order,
             bad_triplets_are_refused);
    ADD_CASE(suite, "files", a_file_is_the_matrix_that_it_says,
             bad_files_are_refused_with_their_line,
             another_reader_agrees_where_the_file_is_good,
             dampers_of_a_folder_have_matrices_and_numbers);
    return run_suite(suite);
}
