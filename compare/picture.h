/* A picture: numbers, a gnuplot script that draws them, and what gnuplot makes of the two. The files are
 * NAME.dat, NAME.gp, NAME.svg and NAME.pdf in one folder, where "gnuplot NAME.gp" draws NAME.svg again. */
#ifndef CRITVEL_COMPARE_PICTURE_H
#define CRITVEL_COMPARE_PICTURE_H

#include <limits.h>
#include <stdio.h>

#include "common/status.h"

enum { CMP_PICTURE_NAME = 128, CMP_PICTURE_SHOWS = 256 };

typedef struct {
    char name[CMP_PICTURE_NAME];   /* safe as a file name */
    char shows[CMP_PICTURE_SHOWS]; /* one line for people */
    int absent;                    /* there is nothing to draw; shows says why */
    cv_message doubt;              /* what is undecided about it; empty: nothing */
    FILE *data, *script;           /* to be written by who draws */
    char *data_bytes, *script_bytes;
    size_t data_size, script_size;
} cmp_picture;

/* Both streams are in memory and open. On failure there is nothing to clear. */
cv_status cmp_picture_open(cmp_picture *p, const char *name, cv_message *why);
void cmp_picture_clear(cmp_picture *p);

/* Notes the first doubt. */
void cmp_picture_doubt(cmp_picture *p, const char *text);

enum { CMP_SVG = 1, CMP_PDF = 2 };

typedef struct {
    char path[PATH_MAX];    /* of the folder the pictures go to */
    char gnuplot[PATH_MAX]; /* the program */
    int formats;            /* CMP_SVG | CMP_PDF */
} cmp_album;

/* Makes the folder, parents included, unless it is there, and finds gnuplot. CV_FAILED says what is wrong:
 * gnuplot missing (then no folder is made), not a folder, not to be written to. */
cv_status cmp_album_open(cmp_album *a, const char *path, int formats, cv_message *why);

/* Closes the streams, lets gnuplot draw in a temporary folder and writes the files, each whole or not at all.
 * The same data and script give the same bytes: no date is left in a PDF that cairo < 1.18 made (later ones
 * compress it). CV_FAILED: nothing of this picture is changed unless the message is about writing it. */
cv_status cmp_picture_publish(cmp_picture *p, const cmp_album *a, cv_message *why);

/* What every script begins with: terminal and output for the variable "format", styles 1 to 9 that differ
 * also in grey, borders, the variable "size" of the font. Size in cm of the PDF. (Two blanks somewhere in a
 * text with italic letters make gnuplot preserve all blanks of it in an SVG.) */
void cmp_script_begin(const cmp_picture *p, double width, double height);

/* text as a gnuplot string in quotes, literally: nothing in it is markup. */
void cmp_script_text(FILE *script, const char *text);

#endif
