//! Errors of graphics cards.

/// An error that prevents a picture on this adapter, or on any.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GpuError {
    /// There is no adapter.
    #[error("no graphics adapter was found")]
    NoAdapter,
    /// The adapter gives no device.
    #[error("{adapter} gives no device: {reason}")]
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// The driver's message.
        reason: String,
    },
    /// The adapter computes in f32 only.
    #[error("{adapter} has no numbers in f64")]
    NoDouble {
        /// The adapter's name.
        adapter: String,
    },
    /// The adapter's texture unit does not interpolate f32.
    #[error("{adapter} has no texture unit that interpolates numbers in f32")]
    NoFilter {
        /// The adapter's name.
        adapter: String,
    },
    /// The volume is larger than a texture can be, or has more than 2³¹ numbers.
    #[error("the volume has {} × {} × {} numbers with its border; {adapter} takes at most {most} along an axis, and 2147483648 in all", dims[0], dims[1], dims[2])]
    TooLarge {
        /// Numbers along x, y and z.
        dims: [usize; 3],
        /// The largest number along an axis.
        most: usize,
        /// The adapter's name.
        adapter: String,
    },
    /// A list is larger than a shader can read.
    #[error("{what} takes {bytes} bytes; a shader of {adapter} reads at most {most}")]
    TooManyBytes {
        /// The list.
        what: &'static str,
        /// Its size.
        bytes: u64,
        /// The largest number of bytes.
        most: u64,
        /// The adapter's name.
        adapter: String,
    },
    /// A picture needs more lists than a shader can read and write.
    #[error("the picture has {lists} lists for a shader; {adapter} takes at most {most}")]
    TooManyLists {
        /// The number of lists.
        lists: usize,
        /// The largest number of lists.
        most: u32,
        /// The adapter's name.
        adapter: String,
    },
    /// Memory of the adapter ran out.
    #[error("the memory of {adapter} does not hold {what}")]
    OutOfMemory {
        /// The data.
        what: &'static str,
        /// The adapter's name.
        adapter: String,
    },
    /// The device was lost while it was drawing.
    #[error("{adapter} was lost: {reason}")]
    Lost {
        /// The adapter's name.
        adapter: String,
        /// The driver's message.
        reason: String,
    },
    /// The driver refuses a shader or a command. This is a fault of the program or of the driver.
    #[error("{adapter} refuses a command: {reason}")]
    Refused {
        /// The adapter's name.
        adapter: String,
        /// The driver's message.
        reason: String,
    },
    /// The driver ended a shader that ran too long.
    #[error("{adapter} ended rays before their last sample; it allows too few steps for this picture")]
    Unfinished {
        /// The adapter's name.
        adapter: String,
    },
    /// An effect of the scene has no shader.
    #[error("graphics cards cannot draw {what} yet")]
    Missing {
        /// The effect, as a noun phrase.
        what: &'static str,
        /// The scene key that asks for it.
        key: &'static str,
    },
    /// There are more sample planes than integers of f32 can count.
    #[error("the volume ends {planes} sample planes from the eye; graphics cards count up to {most}")]
    TooManyPlanes {
        /// Planes up to the farthest corner of the volume.
        planes: u64,
        /// The largest number of planes.
        most: u64,
    },
    /// Lines are merged with a shot that was prepared without them.
    #[error("the picture was prepared without lines inside the volume")]
    NoLines,
    /// The function and the material do not match, or styles are missing.
    #[error("material, transfer function and styles do not match")]
    Material,
}
