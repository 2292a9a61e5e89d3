//! The field between voxels ([REC-1] … [REC-4], [CUR-1] … [CUR-3]).
