/* folders.h - folders that are to be written to. */
#ifndef COMMON_FOLDERS_H
#define COMMON_FOLDERS_H

/* Makes a folder and those above it, where they are not there. 0, or -1, and errno says why. Paths of 512 and
 * more characters are refused, so that callers have room for a file's name behind them. */
int make_folders(const char *path);

/* The same for those that a file lies in. */
int make_folders_of(const char *file);

#endif
