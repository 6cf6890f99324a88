//! Macros that call blocking methods, or their async counterparts. A scenario gets one of the macros as `$way`.

/// Calls a blocking method of a client or an accessor.
macro_rules! blocking {
    ($client:expr, read_block $block:expr) => {
        $client.read_block($block)
    };
    ($client:expr, write_block $block:expr, $values:expr) => {
        $client.write_block($block, $values)
    };
    ($client:expr, write_masked $item:expr, $value:expr, $mask:expr) => {
        $client.write_masked($item, $value, $mask)
    };
    ($client:expr, exchange $write:expr, $values:expr, $read:expr) => {
        $client.exchange($write, $values, $read)
    };
    ($accessor:expr, read) => {
        $accessor.read()
    };
    ($accessor:expr, read_into $buffer:expr) => {
        $accessor.read_into($buffer)
    };
    ($accessor:expr, read_scaled) => {
        $accessor.read_scaled()
    };
    ($accessor:expr, write $value:expr) => {
        $accessor.write($value)
    };
    ($accessor:expr, write_scaled $value:expr) => {
        $accessor.write_scaled($value)
    };
}

/// Calls an async method of a client or an accessor.
macro_rules! awaited {
    ($client:expr, read_block $block:expr) => {
        $client.read_block_async($block).await
    };
    ($client:expr, write_block $block:expr, $values:expr) => {
        $client.write_block_async($block, $values).await
    };
    ($client:expr, write_masked $item:expr, $value:expr, $mask:expr) => {
        $client.write_masked_async($item, $value, $mask).await
    };
    ($client:expr, exchange $write:expr, $values:expr, $read:expr) => {
        $client.exchange_async($write, $values, $read).await
    };
    ($accessor:expr, read) => {
        $accessor.read_async().await
    };
    ($accessor:expr, read_into $buffer:expr) => {
        $accessor.read_into_async($buffer).await
    };
    ($accessor:expr, read_scaled) => {
        $accessor.read_scaled_async().await
    };
    ($accessor:expr, write $value:expr) => {
        $accessor.write_async($value).await
    };
    ($accessor:expr, write_scaled $value:expr) => {
        $accessor.write_scaled_async($value).await
    };
}
