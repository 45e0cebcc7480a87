/* src/input/fvi_files.h -- Which file does a name stand for? */
#ifndef FVI_FILES_H
#define FVI_FILES_H

/* fvi_same_file -- nonzero if the names a and b, which may differ, stand for one ordinary file
 * that is there, or for one that both would make; NULL stands for standard output. Names of
 * terminals, pipes and devices are the same only if they are equal. */
int fvi_same_file(const char *a, const char *b);

#endif
