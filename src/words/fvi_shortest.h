/* src/words/fvi_shortest.h -- A number as a word. */
#ifndef FVI_SHORTEST_H
#define FVI_SHORTEST_H

/* fvi_shortest -- the shortest decimal number that is read back as v, finite. Of those
 * with as many digits the nearest to v. Returns its length. */
int fvi_shortest(double v, char text[32]);

#endif
