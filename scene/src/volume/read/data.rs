//! Voxels from data files: lengths checked first, then decoded in steps.

use super::Choose;
use super::error::{Fault, ReadError, quoted};
use super::header::open;
use super::limits::{Encoding, make_room};
use crate::memory::NoRoom;
use crate::source::{Content, Source};
use crate::space::Grid;
use crate::volume::bytes::Stored;
use crate::volume::{Anatomy, KeptVoxels, Volume, VolumeError, VoxelType, Voxels};
use bzip2::bufread::MultiBzDecoder;
use flate2::bufread::{MultiGzDecoder, ZlibDecoder};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// Bytes that are decoded at a time.
const CHUNK: usize = 1 << 16;

/// Bytes behind the last voxel that are counted for the message before counting stops.
const COUNTED: u128 = 1 << 24;

/// The longest number in text: the digits of the smallest f64 in full, with room.
const LONGEST: usize = 1200;

/// The voxels' layout and position, from a header.
pub(super) struct Payload<'a> {
    /// The source of the files.
    pub(super) source: &'a dyn Source,
    /// The header.
    pub(super) header: &'a Path,
    /// The field of the header that has the sizes.
    pub(super) sizes: &'static str,
    /// Number of voxels.
    pub(super) count: usize,
    /// The type of the numbers.
    pub(super) voxel_type: VoxelType,
    /// Whether the bytes of a number come highest first.
    pub(super) big_endian: bool,
    /// The files, each with an equal share of the voxels.
    pub(super) files: Vec<PathBuf>,
    /// The byte of each at which the stored data begin.
    pub(super) start: u64,
    /// Whether bytes from there on are left out so that the data, which are raw, end with the file.
    pub(super) from_end: bool,
    /// Lines to skip from there.
    pub(super) lines: u64,
    /// Lines of the file before the start.
    pub(super) lines_before: usize,
    /// The encoding of the data.
    pub(super) encoding: Encoding,
    /// Decoded bytes before the first voxel.
    pub(super) inside: u64,
}

/// One data file whose length has been found to fit.
struct FilePart<'a> {
    path: &'a Path,
    offset: u64,
}

impl Payload<'_> {
    /// Reads the voxels that are kept. No memory is asked for before the length of every file has been found to allow
    /// all voxels.
    pub(super) fn read(&self, kept: &KeptVoxels) -> Result<Voxels, ReadError> {
        macro_rules! by_type {
            ($($variant:ident)*) => {
                match self.voxel_type {
                    $(VoxelType::$variant => Voxels::$variant(self.decode(kept)?),)*
                }
            };
        }
        Ok(by_type!(U8 I8 U16 I16 U32 I32 U64 I64 F32 F64))
    }

    /// Voxels in each file.
    fn share(&self) -> Result<usize, ReadError> {
        let files = self.files.len();
        if files == 0 || !self.count.is_multiple_of(files) {
            return Err(ReadError::new(self.header, Fault::Shares { voxels: self.count, files }));
        }
        Ok(self.count / files)
    }

    /// An error about a data file that the sizes in the header do not fit.
    fn misfit(&self, path: &Path, fault: Fault) -> ReadError {
        let field = if path == self.header {
            self.sizes.to_string()
        } else {
            format!("{} of {}", self.sizes, self.header.display())
        };
        ReadError::new(path, fault).field(field)
    }

    /// Finds where the stored data of a file begin, and checks that what the header claims can be in them.
    fn check<'p>(&self, path: &'p Path, share: usize) -> Result<FilePart<'p>, ReadError> {
        let (file, len) = open(self.source, path)?;
        let voxel = self.voxel_type.bytes();
        let expected = share as u128 * voxel as u128;
        let mut offset = self.start;
        if self.from_end {
            let found = u128::from(len.saturating_sub(self.start));
            // The difference is below the length, which is a u64.
            offset += found
                .checked_sub(expected)
                .map(|before| before as u64)
                .ok_or_else(|| self.misfit(path, Fault::Short { expected, found, unit: "bytes" }))?;
        }
        if self.lines > 0 {
            offset += self.skip_lines(path, file, offset)?;
        }
        let stored = len.saturating_sub(offset);
        if self.encoding == Encoding::Raw {
            let found = u128::from(stored.saturating_sub(self.inside));
            return match found.cmp(&expected) {
                std::cmp::Ordering::Less => Err(Fault::Short { expected, found, unit: "bytes" }),
                std::cmp::Ordering::Equal => Ok(FilePart { path, offset }),
                std::cmp::Ordering::Greater => Err(Fault::Long { expected, found, at_least: false, unit: "bytes" }),
            }
            .map_err(|fault| self.misfit(path, fault));
        }
        // Bytes to skip are part of what a compressed file decodes to, and of the text itself.
        let (claimed, limit) = match self.encoding {
            Encoding::Text => (expected, self.encoding.most(stored.saturating_sub(self.inside), voxel)),
            _ => (expected + u128::from(self.inside), self.encoding.most(stored, voxel)),
        };
        if claimed > limit {
            return Err(self.misfit(path, Fault::Oversized { claimed, limit }));
        }
        Ok(FilePart { path, offset })
    }

    /// Bytes of the lines to skip from `offset` on.
    fn skip_lines(&self, path: &Path, mut file: Box<dyn Content + '_>, offset: u64) -> Result<u64, ReadError> {
        let failed = |e| ReadError::io(path, e);
        file.seek(SeekFrom::Start(offset)).map_err(failed)?;
        let mut reader = BufReader::new(file);
        let mut bytes = 0;
        for skipped in 0..self.lines {
            let n = reader.skip_until(b'\n').map_err(failed)?;
            if n == 0 {
                let (expected, found) = (self.lines.into(), skipped.into());
                return Err(ReadError::new(path, Fault::Short { expected, found, unit: "lines to skip" }));
            }
            bytes += n as u64;
        }
        Ok(bytes)
    }

    fn decode<T: Stored>(&self, kept: &KeptVoxels) -> Result<Vec<T>, ReadError> {
        let share = self.share()?;
        let parts: Vec<FilePart> = self.files.iter().map(|path| self.check(path, share)).collect::<Result<_, _>>()?;
        let mut sink = Sink { payload: self, kept, arrived: 0, chunk: Vec::new(), voxels: Vec::new() };
        if self.encoding == Encoding::Raw {
            sink.make_room(kept.len())?;
        }
        for part in &parts {
            let failed = |e| ReadError::io(part.path, e);
            let (mut file, _) = open(self.source, part.path)?;
            file.seek(SeekFrom::Start(part.offset)).map_err(failed)?;
            let mut reader = BufReader::with_capacity(CHUNK, file);
            match self.encoding {
                Encoding::Raw => self.stream(part, &mut reader, share, &mut sink)?,
                Encoding::Text => self.text(part, &mut reader, share, &mut sink)?,
                Encoding::Zlib if !reader.fill_buf().map_err(failed)?.starts_with(&[0x1f, 0x8b]) => {
                    let mut decoder = ZlibDecoder::new(reader);
                    self.stream(part, &mut decoder, share, &mut sink)?;
                    if !decoder.into_inner().fill_buf().map_err(failed)?.is_empty() {
                        let after = "bytes follow the end of the compressed stream".to_string();
                        return Err(ReadError::new(part.path, Fault::Damaged(after)));
                    }
                }
                Encoding::Zlib | Encoding::Gzip => {
                    self.stream(part, &mut MultiGzDecoder::new(reader), share, &mut sink)?;
                }
                Encoding::Bzip2 => self.stream(part, &mut MultiBzDecoder::new(reader), share, &mut sink)?,
            }
        }
        Ok(sink.voxels)
    }

    fn no_memory(&self, voxels: usize, no_room: NoRoom) -> ReadError {
        self.misfit(self.header, Fault::Memory { voxels, no_room })
    }

    /// Takes `share` numbers from a stream of bytes, which must end behind them.
    fn stream<T: Stored>(
        &self,
        part: &FilePart,
        reader: &mut dyn Read,
        share: usize,
        sink: &mut Sink<T>,
    ) -> Result<(), ReadError> {
        let mut stream = DecodedStream { path: part.path, reader, cut: false };
        let expected = share as u128 * size_of::<T>() as u128;
        let short = |found| self.misfit(part.path, Fault::Short { expected, found, unit: "bytes" });
        // Bytes to skip in the decoded data.
        let mut buffer = vec![0; CHUNK];
        let mut skip = self.inside;
        while skip > 0 {
            let piece = &mut buffer[..skip.min(CHUNK as u64) as usize];
            if stream.fill(piece)? < piece.len() {
                return Err(short(0));
            }
            skip -= piece.len() as u64;
        }
        // The numbers, chunk by chunk: memory grows with the data that arrive, not with the header's claim.
        let mut found = 0;
        while found < expected {
            let piece = &mut buffer[..(expected - found).min(CHUNK as u128) as usize];
            let n = stream.fill(piece)?;
            found += n as u128;
            if n < piece.len() {
                return Err(short(found));
            }
            sink.take(piece)?;
        }
        // Reading to the end also lets the decoder check its sums.
        loop {
            let n = stream.fill(&mut buffer)?;
            found += n as u128;
            let at_least = found - expected > COUNTED;
            if n == CHUNK && !at_least {
                continue;
            }
            return if found > expected {
                Err(self.misfit(part.path, Fault::Long { expected, found, at_least, unit: "bytes" }))
            } else if stream.cut {
                Err(ReadError::new(
                    part.path,
                    Fault::Damaged("the stream ends too early, or something follows it".to_string()),
                ))
            } else {
                Ok(())
            };
        }
    }

    /// Takes `share` numbers from text, which must hold no more.
    fn text<T: Stored>(
        &self,
        part: &FilePart,
        reader: &mut dyn BufRead,
        share: usize,
        sink: &mut Sink<T>,
    ) -> Result<(), ReadError> {
        // Numbers found so far, the line for messages, and the digits of the number being read.
        let mut found = 0;
        let mut line = self.lines_before + self.lines as usize + 1;
        let mut word = Vec::new();
        let mut skip = self.inside;
        loop {
            let chunk = reader.fill_buf().map_err(|e| ReadError::io(part.path, e))?;
            let ended = chunk.is_empty();
            // A separator behind the last number, which may have none.
            for &c in if ended { b" " } else { chunk } {
                if skip > 0 && !ended {
                    skip -= 1;
                } else if !(c.is_ascii_whitespace() || c == b',') {
                    if word.len() < LONGEST {
                        word.push(c);
                    }
                } else if !word.is_empty() {
                    if found < share {
                        let text = String::from_utf8_lossy(&word);
                        let number = text.parse().map_err(|_| {
                            let expected = format!("a number of type {}", self.voxel_type.name());
                            ReadError::new(part.path, Fault::Value { found: quoted(&text), expected }).line(line)
                        })?;
                        sink.take_number(number)?;
                    }
                    found += 1;
                    word.clear();
                }
                line += usize::from(c == b'\n');
            }
            if ended {
                break;
            }
            let n = chunk.len();
            reader.consume(n);
        }
        let (expected, found) = (share as u128, found as u128);
        match found.cmp(&expected) {
            std::cmp::Ordering::Less => Err(self.misfit(part.path, Fault::Short { expected, found, unit: "numbers" })),
            std::cmp::Ordering::Equal => Ok(()),
            std::cmp::Ordering::Greater => {
                Err(self.misfit(part.path, Fault::Long { expected, found, at_least: false, unit: "numbers" }))
            }
        }
    }
}

/// The kept voxels of those that have arrived.
struct Sink<'a, T> {
    payload: &'a Payload<'a>,
    kept: &'a KeptVoxels,
    /// Number of voxels that have arrived, kept or not.
    arrived: usize,
    /// Voxels of which not all are kept.
    chunk: Vec<T>,
    voxels: Vec<T>,
}

impl<T: Stored> Sink<'_, T> {
    /// Takes the bytes of the next voxels, a whole number of them.
    fn take(&mut self, bytes: &[u8]) -> Result<(), ReadError> {
        let n = bytes.len() / size_of::<T>();
        if self.kept.is_all() {
            self.make_room(n)?;
            T::append(bytes, self.payload.big_endian, &mut self.voxels);
        } else {
            self.chunk.clear();
            T::append(bytes, self.payload.big_endian, &mut self.chunk);
            // A kept voxel is at most each of those that arrived, and at most each that is still to come.
            self.make_room(n.min(self.kept.len() - self.voxels.len()))?;
            self.kept.append(&self.chunk, self.arrived, &mut self.voxels);
        }
        self.arrived += n;
        Ok(())
    }

    /// Takes the next voxel.
    fn take_number(&mut self, number: T) -> Result<(), ReadError> {
        self.make_room(1.min(self.kept.len() - self.voxels.len()))?;
        self.kept.append(&[number], self.arrived, &mut self.voxels);
        self.arrived += 1;
        Ok(())
    }

    /// Makes room for `more` kept voxels.
    fn make_room(&mut self, more: usize) -> Result<(), ReadError> {
        let total = self.kept.len();
        make_room(&mut self.voxels, more, total).map_err(|no_room| self.payload.no_memory(total, no_room))
    }
}

/// Reads the voxels that `choose` keeps, and makes their volume.
pub(super) fn volume_of(
    file: &Path,
    whole: &Grid,
    payload: &Payload,
    [slope, intercept]: [f64; 2],
    anatomy: Option<Anatomy>,
    choose: &Choose<'_>,
) -> Result<Volume, ReadError> {
    let kept = choose(whole, anatomy).map_err(|error| ReadError::new(file, error))?;
    let grid = kept.grid(whole).map_err(|error| ReadError::new(file, error))?;
    match Volume::new(grid, payload.read(&kept)?, slope, intercept) {
        Ok(volume) => Ok(volume.with_anatomy(anatomy)),
        Err(error @ VolumeError::Scaling { .. }) => Err(ReadError::new(file, error).field("slope and intercept")),
        Err(error) => Err(ReadError::new(file, error)),
    }
}

/// A stream of decoded bytes.
struct DecodedStream<'a> {
    path: &'a Path,
    reader: &'a mut dyn Read,
    /// Whether a compressed stream ended before its end.
    cut: bool,
}

impl DecodedStream<'_> {
    /// Reads until the buffer is full or the stream ends, and says how many bytes came.
    fn fill(&mut self, buffer: &mut [u8]) -> Result<usize, ReadError> {
        let mut filled = 0;
        while filled < buffer.len() && !self.cut {
            match self.reader.read(&mut buffer[filled..]) {
                Ok(0) => break,
                Ok(n) => filled += n,
                Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
                Err(e) if e.kind() == io::ErrorKind::UnexpectedEof => self.cut = true,
                Err(e) if matches!(e.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::InvalidData) => {
                    return Err(ReadError::new(self.path, Fault::Damaged(e.to_string())));
                }
                Err(e) => return Err(ReadError::io(self.path, e)),
            }
        }
        Ok(filled)
    }
}
