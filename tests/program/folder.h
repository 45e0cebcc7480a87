/* tests/program/folder.h -- A folder of matrices, for the tests of --system. */
#ifndef FOLDER_H
#define FOLDER_H

#include "program.h"

#define HEAD "%%MatrixMarket matrix coordinate real symmetric\n"

/* Three masses between two walls. */
static inline void write_chain(void)
{
    ck_assert_int_eq(shell("mkdir -p chain"), 0);
    write_file("chain/M.mtx", HEAD "% masses\n3 3 3\n1 1 1\n2 2 2\n3 3 0.5\n");
    write_file("chain/K.mtx",
               HEAD "3 3 5\n1 1 4\n2 1 -2\n2 2 4\n3 2 -2\n3 3 4\n");
    write_file("chain/C.mtx", HEAD "3 3 2\n1 1 0.3\n3 3 0.1\n");
}

#endif
